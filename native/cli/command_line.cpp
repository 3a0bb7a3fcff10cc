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

constexpr double largest_gap = 0.1;  // of the unit: RefineOptions::gap

/// The program's options as CLI11 knows them, and what they fill in.
class Parser {
 public:
  Parser() {
    app_.set_help_flag("-h,--help", "Print this help");
    app_.set_version_flag("--version", std::string("atlas-refine ") + version(), "Print the version");
    app_.require_subcommand(0, 1);
    app_.get_formatter()->column_width(34);
    add_files();
    add_goal();
    add_distortion();
    add_rectangles();
    add_gap();
    add_running();
    add_measure();
  }

  CommandLine parse(int argc, char** argv) {
    try {
      app_.parse(argc, argv);
    } catch (const CLI::CallForHelp&) {
      print(measure_->parsed() ? measure_->help("atlas-refine") : app_.help());
      return line_;
    } catch (const CLI::CallForVersion& version) {
      print(std::string(version.what()) + "\n");
      return line_;
    } catch (const CLI::ExtrasError&) {
      const auto extras = app_.remaining(true);
      const std::string first = extras.empty() ? "arguments" : extras.front();
      throw UsageError(first + (first.starts_with("-") ? ": unknown option" : ": unexpected argument"));
    } catch (const CLI::ArgumentMismatch& error) {
      // "--gap: 1 required TEXT missing", "json was given a disallowed flag override"
      const std::string what = error.what();
      const std::string name = what.substr(0, what.find_first_of(": "));
      throw UsageError(name.starts_with("-") ? name + ": needs exactly one value" : "--" + name + ": takes no value");
    }
    finish();
    return line_;
  }

 private:
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
  CLI::Option* add(const char* names, const char* unit, const std::string& help, const Setter& set) {
    return add(app_, names, unit, help, set);
  }

  void add_files() {
    app_.add_option("IN.obj", line_.inputs, "The atlas: an OBJ file with UVs; several files get one atlas together")
        ->type_name("");
    add("-o,--output", "OUT.obj|DIR",
        "Where the result goes: IN with new UVs, everything else as it was; of several files, the folder for files of their "
        "names, "
        "which is created where missing",
        [this](const Value& v) { line_.output = v.text; });
    add("--report", "R.json", "Write what was done and measured", [this](const Value& v) { line_.report = v.text; });
    add("--svg", "DIR", "Draw the atlas at each stage with a stretch heat map; DIR is created where missing",
        [this](const Value& v) { line_.svg_folder = v.text; });
  }

  void add_goal() {
    RefineOptions& options = line_.options;
    add("--pe-bound", "PE", "Packing efficiency to reach, between 0 and 1 [0.8]",
        [&](const Value& v) { options.pe_bound = v.number_in(0, 1, true, "a number between 0 and 1, both excluded"); });
    add("--seams", "none|rectangles",
        "Where new seams may come from: none are added, or charts are cut into rectangles (Liu et al. 2019) [none]",
        [&](const Value& v) {
          if (v.text != "none" && v.text != "rectangles") v.refuse("must be 'none' or 'rectangles'");
          options.seams = v.text == "none" ? Seams::None : Seams::Rectangles;
        });
    add("--aspect", "free|square|W:H", "Shape of the box PE is measured in [free]",
        [&](const Value& v) { options.box_aspect = aspect(v); });
    app_.add_flag("--relax", options.relax, "Where less would hold the bound, go on to the least distortion under it")
        ->disable_flag_override();
    app_.add_flag("--best-effort", options.best_effort, "Write the best valid atlas found even if it misses the bound")
        ->disable_flag_override();
    add("--density", "equal|keep", "One scale for all charts, or each chart's own as in IN [equal]", [&](const Value& v) {
      if (v.text != "equal" && v.text != "keep") v.refuse("must be 'equal' or 'keep'");
      options.density = v.text == "keep" ? Density::Keep : Density::Equal;
    });
  }

  void add_distortion() {
    RefineOptions& options = line_.options;
    add("--max-distortion", "E_d", "Largest distortion E_d allowed, 1 = isometric [no limit]",
        [&](const Value& v) { options.max_distortion = v.number_in(1, HUGE_VAL, false, "a number of at least 1"); });
    add("--reference", "surface|input", "What distortion is reduced against: the surface, or the UVs of IN [surface]",
        [&](const Value& v) {
          if (v.text != "surface" && v.text != "input") v.refuse("must be 'surface' or 'input'");
          options.reference = v.text == "input" ? Reference::Input : Reference::Surface;
        });
    add("--importance", "FILE", "One positive number for each face of IN, in its order: what the face counts in E_d [all 1]",
        [this](const Value& v) { line_.importance = v.text; });
  }

  /// An option that only --seams rectangles reads.
  void add_for_rectangles(const char* name, const char* unit, const std::string& help, const Setter& set) {
    add(name, unit, "With rectangles: " + help, [this, name, set](const Value& v) {
      set(v);
      first_for_rectangles_ = first_for_rectangles_ ? first_for_rectangles_ : name;
    });
  }

  void add_rectangles() {
    RectangleOptions& options = line_.options.rectangles;
    add_for_rectangles("--sigma", "FRACTION", "width of the boundary smoothing / length of the chart's boundary [0.004]",
                       [&](const Value& v) {
                         constexpr const char* expected = "a number above 0 and at most 0.1";
                         options.sigma = v.number_in(0, 0.1, false, expected);
                         if (options.sigma == 0) v.refuse(std::string("must be ") + expected);
                       });
    add_for_rectangles("--candidates", "N", "layouts that are packed and scored [500]", [&](const Value& v) {
      constexpr const char* expected = "a whole number from 1 to 1000000";
      options.candidates = v.as<int>(expected);
      if (options.candidates < 1 || options.candidates > 1000000) v.refuse(std::string("must be ") + expected);
    });
    add_for_rectangles("--omega", "W", "what boundary length costs against PE, from 0 to 1 [0.1]",
                       [&](const Value& v) { options.omega = v.number_in(0, 1, false, "a number from 0 to 1"); });
    until_input_ = app_.add_flag("--until-input", options.until_input,
                                 "With rectangles: stop where the distortion is back at that of IN, as the paper does");
    until_input_->disable_flag_override();
  }

  void add_gap() {
    auto* gap = add("--gap", "FRACTION",
                    "Guaranteed smallest distance between charts / diagonal of the box "
                    "[0.0025, reduced only as far as the bound needs]",
                    [&](const Value& v) {
                      const double value = v.number_in(0, largest_gap, false, "a number from 0 to 0.1");
                      line_.options.gap = Gap{value, Gap::Unit::BoxDiagonal};
                    });
    auto* texels = add("--gap-px", "N", "The same in texels of a texture of --texture-size",
                       [&](const Value& v) { gap_texels_ = v.number_in(0, HUGE_VAL, false, "a number of texels"); });
    auto* size = add("--texture-size", "S", "Texels along the longer side of the texture", [&](const Value& v) {
      texture_size_ = v.as<unsigned>("a whole number of texels");
      if (*texture_size_ == 0) v.refuse("must be at least 1");
    });
    size->option_text("S");
    gap->option_text("FRACTION");
    texels->option_text("N");
  }

  void add_running() {
    RefineOptions& options = line_.options;
    add("--seed", "N", "Seed of every random choice [1]",
        [&](const Value& v) { options.seed = v.as<std::uint64_t>("a whole number from 0 on"); });
    add("--threads", "N", "Threads, 0 = as many as the machine has; the result is the same [0]", [&](const Value& v) {
      options.threads = v.as<int>("a whole number from 0 on");
      if (options.threads < 0) v.refuse("must be a whole number from 0 on");
    });
  }

  void add_measure() {
    measure_ = app_.add_subcommand("measure", "Print the measures of FILE and whether its atlas is valid; changes nothing");
    add(*measure_, "FILE", "", "The atlas: an OBJ file with UVs", [this](const Value& v) { line_.inputs = {v.text}; });
    add(*measure_, "--aspect", "free|square|W:H", "Shape of the box PE is measured in [free]",
        [this](const Value& v) { line_.options.box_aspect = aspect(v); });
    measure_->add_flag("--json", line_.json, "Print JSON instead of a table")->disable_flag_override();
  }

  void finish() {
    if (measure_->parsed()) {
      line_.job = CommandLine::Job::Measure;
      if (line_.inputs.empty()) throw UsageError("FILE: missing; say atlas-refine measure FILE");
      return;
    }
    if (line_.inputs.empty()) throw UsageError("IN.obj: missing; say atlas-refine IN.obj -o OUT.obj");
    if (line_.output.empty()) throw UsageError("--output: missing; say where the result goes with -o OUT.obj");
    check_names();
    if (until_input_->count() > 0 && !first_for_rectangles_) first_for_rectangles_ = "--until-input";
    if (first_for_rectangles_ && line_.options.seams != Seams::Rectangles)
      throw UsageError(std::string(first_for_rectangles_) + ": needs --seams rectangles");
    finish_gap();
  }

  /// The results of a collection must not overwrite each other.
  void check_names() const {
    std::set<std::filesystem::path> names;
    for (const auto& input : line_.inputs) {
      if (!line_.is_collection()) return;
      if (!input.has_filename()) throw UsageError(input.string() + ": is not the name of a file");
      if (!names.insert(input.filename()).second)
        throw UsageError(input.string() + ": a second file of this name, results would overwrite each other");
    }
  }

  void finish_gap() {
    if (gap_texels_ && line_.options.gap) throw UsageError("--gap-px: cannot be combined with --gap");
    if (gap_texels_ && !texture_size_) throw UsageError("--gap-px: needs --texture-size");
    if (texture_size_ && !gap_texels_) throw UsageError("--texture-size: needs --gap-px");
    if (!gap_texels_) return;
    const double value = *gap_texels_ / *texture_size_;
    if (value > largest_gap) throw UsageError("--gap-px: more than a tenth of the texture");
    line_.options.gap = Gap{value, Gap::Unit::LongSide};
  }

  void print(const std::string& text) {
    line_.job = CommandLine::Job::PrintText;
    line_.text = text;
  }

  CommandLine line_;
  std::optional<double> gap_texels_;
  std::optional<unsigned> texture_size_;
  const char* first_for_rectangles_ = nullptr;  // the first such option on the line
  CLI::Option* until_input_ = nullptr;
  CLI::App* measure_ = nullptr;
  CLI::App app_{
      "Brings the UV atlas of OBJ files to a packing efficiency bound, without a new seam or with charts cut into rectangles.\n"
      "Exit codes: 0 done, 2 usage, 3 input cannot be used, 4 bound not reached, 130 Ctrl-C.",
      "atlas-refine"};
};

}  // namespace

CommandLine parse_command_line(int argc, char** argv) {
  try {
    return Parser().parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    throw UsageError(error.what());
  }
}

}  // namespace atlas_refine::cli
