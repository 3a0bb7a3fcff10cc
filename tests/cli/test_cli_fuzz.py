"""Random damage to a small OBJ file: the program refuses or works, and never crashes."""

import random
from concurrent.futures import ThreadPoolExecutor

import pytest
from obj_shapes import grid

MUTATIONS = 400
JUNK = ["", "\n", "\x00", "nan", "1e400", "1e-400", "0", "-1", "99", "-99", "/", "//", "1/", "1/1/1", "f", "vt", "\\", "#", "+"]


def truncated(rng, text):
    return text[: rng.randrange(len(text))]


def bytes_deleted(rng, text):
    for _ in range(rng.randint(1, 5)):
        at = rng.randrange(len(text))
        text = text[:at] + text[at + rng.randint(1, 3) :]
    return text


def tokens_swapped(rng, text):
    tokens = text.split(" ")
    for _ in range(rng.randint(1, 3)):
        i, j = rng.randrange(len(tokens)), rng.randrange(len(tokens))
        tokens[i], tokens[j] = tokens[j], tokens[i]
    return " ".join(tokens)


def token_replaced(rng, text):
    tokens = text.split(" ")
    for _ in range(rng.randint(1, 2)):
        tokens[rng.randrange(len(tokens))] = rng.choice(JUNK)
    return " ".join(tokens)


def lines_shuffled(rng, text):
    lines = text.splitlines(keepends=True)
    i, j = rng.randrange(len(lines)), rng.randrange(len(lines))
    lines[i], lines[j] = lines[j], lines[i]
    del lines[rng.randrange(len(lines))]
    return "".join(lines)


def jobs(path, target):
    refine = [path, "-o", target]
    return {"refine": refine, "cut": [*refine, "--seams", "rectangles", "--candidates", "20"], "measure": ["measure", path]}


def mutant(seed):
    rng = random.Random(seed)
    text = grid(3, rng.choice([0, 30]), bump=rng.choice([0, 0.3]), relative=rng.random() < 0.3, normals=rng.random() < 0.5)
    damage = rng.choice([truncated, bytes_deleted, tokens_swapped, token_replaced, lines_shuffled])
    return damage.__name__, damage(rng, text)


@pytest.mark.parametrize("job", ["refine", "cut", "measure"])
def test_damaged_files_never_crash(program, tmp_path, job):
    def run(seed):
        name, text = mutant(seed)
        path, target = tmp_path / f"{seed}.obj", tmp_path / f"{seed}.out.obj"
        path.write_text(text)
        result = program(*jobs(path, target)[job])
        case = f"seed {seed}, {name}: exit {result.returncode}, {result.stderr.decode(errors='replace')}"
        assert result.returncode in ((0, 1, 3) if job == "measure" else (0, 3, 4)), case
        assert result.stderr.count(b"\n") == (0 if result.stdout else 1), case
        assert bool(result.stdout) == (result.returncode in (0, 1)), case
        assert target.exists() == (job != "measure" and result.returncode == 0), case
        return result.returncode

    with ThreadPoolExecutor(2) as pool:
        codes = list(pool.map(run, range(MUTATIONS)))
    assert {0, 3} <= set(codes)
