// What the user asked for: the program's options, checked.
#include "command_line.h"

#include <CLI/CLI.hpp>
#include <charconv>
#include <cmath>
#include <set>

namespace atlas_refine::cli {

namespace {

/// An option's value with the option's name, for messages.
struct Value {
  const char* option;
  std::string text;

  [[noreturn]] void refuse(const std::string& what) const {
    throw UsageError(std::string(option) + ": " + what + ", not '" + text + "'");
  }
  template <class Number>
  Number as(const char* expected) const {
    Number value{};
    const char* end = text.data() + text.size();
    const auto result = std::from_chars(text.data(), end, value);
    if (text.empty() || result.ptr != end || result.ec != std::errc()) refuse(std::string("must be ") + expected);
    return value;
  }
  /// `low` and `high` are allowed unless `open`.
  double number_in(double low, double high, bool open, const char* expected) const {
    const double value = as<double>(expected);
    const bool inside = open ? value > low && value < high : value >= low && value <= high;
    if (!std::isfinite(value) || !inside) refuse(std::string("must be ") + expected);
    return value;
  }
};

double aspect(const Value& value) {
  constexpr const char* expected = "'free', 'square' or W:H with positive numbers";
  if (value.text == "free") return 0;
  if (value.text == "square") return 1;
  const std::size_t colon = value.text.find(':');
  if (colon == std::string::npos) value.refuse(std::string("must be ") + expected);
  const auto side = [&](const std::string& text) {
    double number = 0;
    const auto result = std::from_chars(text.data(), text.data() + text.size(), number);
    const bool whole = !text.empty() && result.ptr == text.data() + text.size() && result.ec == std::errc();
    if (!whole || !(number > 0) || !std::isfinite(number)) value.refuse(std::string("must be ") + expected);
    return number;
  };
  const double ratio = side(value.text.substr(0, colon)) / side(value.text.substr(colon + 1));
  if (!(ratio >= 0.01 && ratio <= 100)) value.refuse("must lie between 1:100 and 100:1");
  return ratio;
}

constexpr const char* aspect_help =
    "Shape of the box PE is measured in; W:H, from 1:100 to 100:1: a texture of W:H, whose UVs fill the unit square [free]";
constexpr double largest_gap = 0.1;  // of the unit: RefineOptions::gap

/// What is read before it is settled.
struct Draft {
  CommandLine line;
  std::optional<double> gap_texels;
  std::optional<unsigned> texture_size;
  const char* first_for_rectangles = nullptr;  ///< the first option on the line that only --seams rectangles reads
  const char* first_for_needed = nullptr;      ///< the same of --seams needed
};

using Setter = std::function<void(const Value&)>;

CLI::Option* add(CLI::App& app, const char* names, const char* unit, const std::string& help, const Setter& set) {
  const std::string_view all = names;
  const char* shown = names + (all.find("--") == all.npos ? 0 : all.find("--"));
  auto* option = app.add_option_function<std::string>(
      names,
      [=](const std::string& text) {
        set({shown, text});
      },
      help);
  return option->type_name(unit)->expected(1)->multi_option_policy(CLI::MultiOptionPolicy::Throw);
}

void add_flag(CLI::App& app, const char* name, bool& flag, const char* help) {
  app.add_flag(name, flag, help)->disable_flag_override();
}

void add_files(CLI::App& app, CommandLine& line) {
  app.add_option("IN.obj", line.inputs, "The atlas: an OBJ file with UVs; several files get one atlas together")->type_name("");
  add(app, "-o,--output", "OUT.obj|DIR",
      "Where the result goes: IN with new UVs, everything else as it was; of several files, the folder for files of their names, "
      "which is created where missing",
      [&](const Value& v) { line.output = v.text; });
  add(app, "--report", "R.json", "Write what was done and measured", [&](const Value& v) { line.report = v.text; });
  add(app, "--svg", "DIR", "Draw the atlas at each stage with a stretch heat map; DIR is created where missing",
      [&](const Value& v) { line.svg_folder = v.text; });
}

void add_goal(CLI::App& app, RefineOptions& options) {
  add(app, "--pe-bound", "PE", "Packing efficiency to reach, between 0 and 1 [0.8]",
      [&](const Value& v) { options.pe_bound = v.number_in(0, 1, true, "a number between 0 and 1, both excluded"); });
  add(app, "--seams", "none|needed|rectangles",
      "Where new seams may come from: none are added, charts are cut where they are above --max-distortion or --max-stretch or "
      "where a cut saves more than --seam-cost, or all are cut into rectangles (Liu et al. 2019) [none]",
      [&](const Value& v) {
        if (v.text != "none" && v.text != "needed" && v.text != "rectangles")
          v.refuse("must be 'none', 'needed' or 'rectangles'");
        options.seams = v.text == "none" ? Seams::None : v.text == "needed" ? Seams::Needed : Seams::Rectangles;
      });
  add(app, "--cut", "split|edges",
      "How cuts run: across faces, which are divided, or along edges of IN's faces, which keeps its mesh exactly [split]",
      [&](const Value& v) {
        if (v.text != "split" && v.text != "edges") v.refuse("must be 'split' or 'edges'");
        options.cut = v.text == "edges" ? Cut::Edges : Cut::Split;
      });
  add(app, "--aspect", "free|square|W:H", aspect_help, [&](const Value& v) { options.box_aspect = aspect(v); });
  add_flag(
      app, "--relax", options.relax,
      "Where less would hold the bound, go on to the least distortion under it; rectangles do so anyway, unless --until-input");
  add_flag(app, "--best-effort", options.best_effort,
           "Where the bound is missed write the best valid atlas found; --max-distortion and --max-stretch are kept all the "
           "same, but with needed seams");
  add(app, "--density", "equal|keep",
      "One scale for all charts, or each chart's own as in IN as far as bending leaves it that [equal]", [&](const Value& v) {
        if (v.text != "equal" && v.text != "keep") v.refuse("must be 'equal' or 'keep'");
        options.density = v.text == "keep" ? Density::Keep : Density::Equal;
      });
}

template <class Choice>
void add_choice(CLI::App& app, const char* name, const char* unit, const std::string& help, Choice& choice,
                std::initializer_list<std::pair<const char*, Choice>> choices) {
  const std::vector<std::pair<std::string, Choice>> known(choices.begin(), choices.end());
  add(app, name, unit, help, [&choice, known](const Value& v) {
    std::string expected;
    for (const auto& [word, value] : known) {
      if (v.text == word) {
        choice = value;
        return;
      }
      expected += (expected.empty() ? "'" : word == known.back().first ? " or '" : ", '") + word + "'";
    }
    v.refuse("must be " + expected);
  });
}

/// What happens to charts that are not like the others.
void add_charts(CLI::App& app, CommandLine& line) {
  RefineOptions& options = line.options;
  add_choice<std::string>(app, "--group-by", "none|material|object|tile",
                          "One atlas for all faces, or one for each material, object or UDIM tile [none]", line.group_by,
                          {{"none", "none"}, {"material", "material"}, {"object", "object"}, {"tile", "tile"}});
  add_choice<Stacks>(app, "--stacks", "keep|separate",
                     "Charts of one shape that lie on each other stay on each other, or get a place each [keep]", options.stacks,
                     {{"keep", Stacks::Keep}, {"separate", Stacks::Separate}});
  add_choice<Collapsed>(
      app, "--collapsed", "leave|embed",
      "Charts whose UVs are a point or a line stay as they are, outside the atlas, or get UVs with area [leave]",
      options.collapsed, {{"leave", Collapsed::Leave}, {"embed", Collapsed::Embed}});
  add_flag(app, "--open-closed", options.open_closed,
           "Charts without a border, or with a handle, may be opened along edges: they cannot be flat without a seam");
  add_flag(app, "--triangulate", options.triangulate, "Write faces that are cut as triangles throughout");
}

void add_distortion(CLI::App& app, CommandLine& line) {
  RefineOptions& options = line.options;
  add(app, "--max-distortion", "E_d", "Largest distortion E_d on the surface allowed, 1 = isometric [no limit]",
      [&](const Value& v) { options.max_distortion = v.number_in(1, HUGE_VAL, false, "a number of at least 1"); });
  add(app, "--max-stretch", "S",
      "Largest stretch allowed of 99 % of the surface: 1.3 lets lengths in the UV map be up to 1.3 times as long or as short as "
      "at its mean scale; reached by less E_d, which is what charts are bent and cut for [no limit]",
      [&](const Value& v) { options.max_stretch = v.number_in(1, HUGE_VAL, false, "a number of at least 1"); });
  add(app, "--reference", "surface|input",
      "The shapes that faces are to keep: those on the surface, or in the UVs of IN [surface]", [&](const Value& v) {
        if (v.text != "surface" && v.text != "input") v.refuse("must be 'surface' or 'input'");
        options.reference = v.text == "input" ? Reference::Input : Reference::Surface;
      });
  add(app, "--importance", "FILE",
      "One positive number for each face of IN, in its order: what the face counts while distortion is reduced [all 1]",
      [&](const Value& v) { line.importance = v.text; });
}

void add_kept(CLI::App& app, CommandLine& line) {
  RefineOptions& options = line.options;
  add(app, "--keep-shape", "FILE",
      "0 or 1 for each face of IN, in its order: charts with a face of 1 are only moved, their shapes stay [all 0]",
      [&](const Value& v) { line.keep_shape = v.text; });
  add(app, "--locked", "FILE",
      "The same: charts with a face of 1 stay where they are in the texture, others go around them [all 0]",
      [&](const Value& v) { line.locked = v.text; });
  add(app, "--no-seam", "FILE", "Edges that no cut runs along: pairs of vertices of IN, counted from 0 [none]",
      [&](const Value& v) { line.no_seam = v.text; });
  add(app, "--prefer-seam", "FILE", "Edges that cuts along edges like to follow: pairs of vertices, counted from 0 [none]",
      [&](const Value& v) { line.prefer_seam = v.text; });
  add(app, "--rotate", "any|90|none", "How charts may be turned where they are only moved [any]", [&](const Value& v) {
    if (v.text != "any" && v.text != "90" && v.text != "none") v.refuse("must be 'any', '90' or 'none'");
    options.rotate = v.text == "any" ? Rotate::Any : v.text == "90" ? Rotate::QuarterTurns : Rotate::None;
  });
  add_flag(app, "--align-axes", options.align_axes,
           "Where charts are moved, turn those whose longest border runs straight so that it lies on an axis");
}

void add_needed(CLI::App& app, Draft& draft) {
  RefineOptions& options = draft.line.options;
  const auto add_one = [&](const char* name, const char* unit, const std::string& help, const Setter& set) {
    add(app, name, unit, "With needed seams: " + help, [&draft, name, set](const Value& v) {
      set(v);
      if (!draft.first_for_needed) draft.first_for_needed = name;
    });
  };
  add_one("--max-boundary-growth", "R", "how much boundary cuts may add, as a fraction of that of all charts [no limit]",
          [&](const Value& v) { options.max_boundary_growth = v.number_in(0, HUGE_VAL, false, "a number of at least 0"); });
  add_one("--seam-cost", "C",
          "without --max-distortion or --max-stretch, the E_d that a cut must save for each unit of boundary growth [0.1]",
          [&](const Value& v) { options.seam_cost = v.number_in(0, HUGE_VAL, false, "a number of at least 0"); });
  add_one("--effort", "fast|normal|best", "how many cuts are tried: the more, the fewer seams [normal]", [&](const Value& v) {
    if (v.text != "fast" && v.text != "normal" && v.text != "best") v.refuse("must be 'fast', 'normal' or 'best'");
    options.effort = v.text == "fast" ? Effort::Fast : v.text == "best" ? Effort::Best : Effort::Normal;
  });
  add_one("--trade-off", "T.csv",
          "look for all outcomes that are worth a choice between seams and distortion, and write them, and E_d without cuts from "
          "PE 0.60 to 0.95, as a table and, beside it, a picture T.svg",
          [&](const Value& v) {
            draft.line.trade_off = v.text;
            if (draft.line.trade_off->extension() != ".csv") v.refuse("must be a name that ends in .csv");
            options.trade_off = true;
          });
  add_one("--point", "K", "which line of the trade-off is written, from 0 on [what the limits ask for]", [&](const Value& v) {
    options.point = v.as<int>("a whole number from 0 on");
    if (*options.point < 0) v.refuse("must be a whole number from 0 on");
  });
}

void add_rectangles(CLI::App& app, Draft& draft) {
  RectangleOptions& options = draft.line.options.rectangles;
  const auto add_one = [&](const char* name, const char* unit, const std::string& help, const Setter& set) {
    add(app, name, unit, "With rectangles: " + help, [&draft, name, set](const Value& v) {
      set(v);
      if (!draft.first_for_rectangles) draft.first_for_rectangles = name;
    });
  };
  add_one("--sigma", "FRACTION", "width of the boundary smoothing / length of the chart's boundary [0.004]", [&](const Value& v) {
    constexpr const char* expected = "a number above 0 and at most 0.1";
    options.sigma = v.number_in(0, 0.1, false, expected);
    if (options.sigma == 0) v.refuse(std::string("must be ") + expected);
  });
  add_one("--candidates", "N", "layouts that are packed and scored [500]", [&](const Value& v) {
    constexpr const char* expected = "a whole number from 1 to 1000000";
    options.candidates = v.as<int>(expected);
    if (options.candidates < 1 || options.candidates > 1000000) v.refuse(std::string("must be ") + expected);
  });
  add_one("--omega", "W", "what boundary length costs against PE, from 0 to 1 [0.1]",
          [&](const Value& v) { options.omega = v.number_in(0, 1, false, "a number from 0 to 1"); });
  add_flag(app, "--until-input", options.until_input,
           "With rectangles: stop where the distortion is back at that of IN, as the paper does");
}

void add_gap(CLI::App& app, Draft& draft) {
  add(app, "--gap", "FRACTION",
      "Guaranteed smallest distance between charts / diagonal of the box [the largest of 0.0025, 0.6 of it, 0.6 of that ... with "
      "which the bound is reached at a sane price]",
      [&](const Value& v) {
        const double value = v.number_in(0, largest_gap, false, "a number from 0 to 0.1");
        draft.line.options.gap = Gap{value, Gap::Unit::BoxDiagonal};
      })
      ->option_text("FRACTION");
  add(app, "--gap-px", "N", "The same in texels of a texture of --texture-size", [&](const Value& v) {
    draft.gap_texels = v.number_in(0, HUGE_VAL, false, "a number of texels");
  })->option_text("N");
  add(app, "--texture-size", "S", "Texels along the longer side of the texture", [&](const Value& v) {
    draft.texture_size = v.as<unsigned>("a whole number of texels");
    if (*draft.texture_size == 0) v.refuse("must be at least 1");
  })->option_text("S");
}

void add_running(CLI::App& app, RefineOptions& options) {
  add(app, "--seed", "N", "Seed of every random choice [1]",
      [&](const Value& v) { options.seed = v.as<std::uint64_t>("a whole number from 0 on"); });
  add(app, "--threads", "N", "Threads, 0 = as many as the machine has; the result is the same [0]", [&](const Value& v) {
    options.threads = v.as<int>("a whole number from 0 on");
    if (options.threads < 0) v.refuse("must be a whole number from 0 on");
  });
}

const CLI::App* add_measure(CLI::App& app, CommandLine& line) {
  CLI::App* measure = app.add_subcommand("measure", "Print the measures of FILE and whether its atlas is valid; changes nothing");
  add(*measure, "FILE", "", "The atlas: an OBJ file with UVs", [&](const Value& v) { line.inputs = {v.text}; });
  add(*measure, "--aspect", "free|square|W:H", aspect_help, [&](const Value& v) { line.options.box_aspect = aspect(v); });
  add_flag(*measure, "--json", line.json, "Print JSON instead of a table");
  return measure;
}

/// The results of a collection must not overwrite each other.
void check_names(const CommandLine& line) {
  if (!line.is_collection()) return;
  std::set<std::filesystem::path> names;
  for (const auto& input : line.inputs) {
    if (!input.has_filename()) throw UsageError(input.string() + ": is not the name of a file");
    if (!names.insert(input.filename()).second)
      throw UsageError(input.string() + ": a second file of this name, results would overwrite each other");
  }
}

void settle_gap(Draft& draft) {
  std::optional<Gap>& gap = draft.line.options.gap;
  if (draft.gap_texels && gap) throw UsageError("--gap-px: cannot be combined with --gap");
  if (draft.gap_texels && !draft.texture_size) throw UsageError("--gap-px: needs --texture-size");
  if (draft.texture_size && !draft.gap_texels) throw UsageError("--texture-size: needs --gap-px");
  if (!draft.gap_texels) return;
  const double value = *draft.gap_texels / *draft.texture_size;
  if (value > largest_gap) throw UsageError("--gap-px: more than a tenth of the texture");
  gap = Gap{value, Gap::Unit::LongSide};
}

CommandLine settled_refine(Draft draft) {
  CommandLine& line = draft.line;
  if (line.inputs.empty()) throw UsageError("IN.obj: missing; say atlas-refine IN.obj -o OUT.obj");
  if (line.output.empty()) throw UsageError("--output: missing; say where the result goes with -o OUT.obj");
  check_names(line);
  if (line.options.rectangles.until_input && !draft.first_for_rectangles) draft.first_for_rectangles = "--until-input";
  if (draft.first_for_rectangles && line.options.seams != Seams::Rectangles)
    throw UsageError(std::string(draft.first_for_rectangles) + ": needs --seams rectangles");
  if (draft.first_for_needed && line.options.seams != Seams::Needed)
    throw UsageError(std::string(draft.first_for_needed) + ": needs --seams needed");
  if (line.options.point && !line.trade_off) throw UsageError("--point: needs --trade-off");
  if (line.options.align_axes && line.options.rotate == Rotate::None)
    throw UsageError("--align-axes: cannot be combined with --rotate none");
  settle_gap(draft);
  return std::move(draft.line);
}

CommandLine settled_measure(CommandLine line) {
  line.job = CommandLine::Job::Measure;
  if (line.inputs.empty()) throw UsageError("FILE: missing; say atlas-refine measure FILE");
  return line;
}

CommandLine printing(std::string text) {
  CommandLine line;
  line.job = CommandLine::Job::PrintText;
  line.text = std::move(text);
  return line;
}

[[noreturn]] void refuse_extras(const std::vector<std::string>& extras) {
  const std::string first = extras.empty() ? "arguments" : extras.front();
  throw UsageError(first + (first.starts_with("-") ? ": unknown option" : ": unexpected argument"));
}

/// Of CLI11's "--gap: 1 required TEXT missing" or "json was given a disallowed flag override".
[[noreturn]] void refuse_count(const std::string& what) {
  const std::string name = what.substr(0, what.find_first_of(": "));
  throw UsageError(name.starts_with("-") ? name + ": needs exactly one value" : "--" + name + ": takes no value");
}

constexpr const char* purpose =
    "Brings the UV atlas of OBJ files to a packing efficiency bound, without a new seam, or cut where that is needed.";
constexpr const char* exit_codes =
    "Exit codes:\n"
    "  0    done\n"
    "  1    internal error, or measure found the atlas invalid\n"
    "  2    usage: an option, or a place that cannot be written\n"
    "  3    input cannot be used\n"
    "  4    bound not reached, --max-distortion or --max-stretch missed, or no result held the exact test\n"
    "  130  Ctrl-C";

}  // namespace

CommandLine parse_command_line(int argc, char** argv) {
  Draft draft;
  CLI::App app{purpose, "atlas-refine"};
  app.footer(exit_codes);
  app.set_help_flag("-h,--help", "Print this help");
  app.set_version_flag("--version", std::string("atlas-refine ") + version(), "Print the version");
  app.require_subcommand(0, 1);
  app.get_formatter()->column_width(34);
  add_files(app, draft.line);
  add_goal(app, draft.line.options);
  add_charts(app, draft.line);
  add_distortion(app, draft.line);
  add_kept(app, draft.line);
  add_needed(app, draft);
  add_rectangles(app, draft);
  add_gap(app, draft);
  add_running(app, draft.line.options);
  const CLI::App* measure = add_measure(app, draft.line);
  try {
    app.parse(argc, argv);
  } catch (const CLI::CallForHelp&) {
    return printing(measure->parsed() ? measure->help("atlas-refine") : app.help());
  } catch (const CLI::CallForVersion& version) {
    return printing(std::string(version.what()) + "\n");
  } catch (const CLI::ExtrasError&) {
    refuse_extras(app.remaining(true));
  } catch (const CLI::ArgumentMismatch& error) {
    refuse_count(error.what());
  } catch (const CLI::ParseError& error) {
    throw UsageError(error.what());
  }
  return measure->parsed() ? settled_measure(std::move(draft.line)) : settled_refine(std::move(draft));
}

}  // namespace atlas_refine::cli
