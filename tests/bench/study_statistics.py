"""The statistics of section 4.2: most, mean and standard deviation over a data set, the paper's beside ours."""

import math
import statistics

# Over the paper's 5588 one-chart models; where it gives no number its histograms are all there is.
PAPER = {
    "PE %": {"most": "97.3", "mean": "82.3", "deviation": "2.95"},
    "dE %": {"mean": "0.0533"},
    "E_2": {"most": "1.106", "mean": "1.021", "deviation": "0.012"},
    "dBL %": {"most": "168", "mean": "78.7"},
    "SAE": {"most": "0.1430", "mean": "0.009", "deviation": "0.0071"},
    "ms / vertex": {"most": "6.40", "mean": "1.32", "deviation": "0.75"},  # it names no unit; its Table 1 fits ms
}
FIGURES = (
    ("PE %", lambda row, _: 100 * row.pe, ".2f"),
    ("dE %", lambda row, _: 100 * row.growth, ".4f"),
    ("E_2", lambda row, _: row.e_2, ".4f"),
    ("dBL %", lambda row, _: 100 * row.added_length, ".1f"),
    ("CN", lambda row, _: row.charts, ".1f"),
    ("N3", lambda row, _: row.small_charts, ".1f"),
    ("SA %", lambda row, _: 100 * row.smallest, ".2f"),
    ("SAE", lambda _, figures: figures.sae, ".4f"),
    ("SAE in", lambda _, figures: figures.sae_in, ".4f"),
    ("ms / vertex", lambda row, _: 1000 * row.time / row.vertices, ".3f"),
)


def statistics_lines(title, results):
    """`results`: (row, figures) of every file; of files that have no result there is only the count."""
    done = [(row, figures) for row, figures in results if row.ok]
    out = [f"{title}: {len(done)} of {len(results)} files; paper: 5588 of 5588"]
    if len(done) < 2:
        return out
    out.append(f"  {'':20}{'most':>10}{'mean':>10}{'deviation':>11}{'least':>10}   paper: most, mean, deviation")
    for name, value, form in FIGURES:
        values = [v for v in (value(row, figures) for row, figures in done) if v is not None and math.isfinite(v)]
        if len(values) < 2:
            continue
        cells = [max(values), statistics.fmean(values), statistics.pstdev(values), min(values)]
        texts = [format(cell, form) for cell in cells]
        theirs = ", ".join(PAPER.get(name, {}).get(which, "-") for which in ("most", "mean", "deviation"))
        out.append(f"  {name:20}{texts[0]:>10}{texts[1]:>10}{texts[2]:>11}{texts[3]:>10}   {theirs}")
    return out
