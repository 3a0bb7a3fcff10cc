// Options as they are read: what they fill in, what is settled at the end, what the help says.
#include "command_line.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace atlas_refine::cli {
namespace {

CommandLine parsed(std::vector<std::string> words) {
  words.insert(words.begin(), "atlas-refine");
  std::vector<char*> argv(words.size());
  std::transform(words.begin(), words.end(), argv.begin(), [](std::string& word) { return word.data(); });
  return parse_command_line(static_cast<int>(argv.size()), argv.data());
}

std::string refusal(const std::vector<std::string>& words) {
  try {
    parsed(words);
  } catch (const UsageError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(CommandLine, HelpListsEveryExitCode) {
  for (const auto& words : {std::vector<std::string>{"--help"}, {"measure", "--help"}}) {
    const CommandLine line = parsed(words);
    EXPECT_EQ(line.job, CommandLine::Job::PrintText);
    for (const char* code : {"0    done", "1    internal error, or measure found the atlas invalid", "2    usage",
                             "3    input cannot be used", "4    bound not reached", "130  Ctrl-C"})
      EXPECT_NE(line.text.find(std::string("\n  ") + code), std::string::npos) << code << "\n" << line.text;
  }
}

TEST(CommandLine, OptionsArrive) {
  const CommandLine line = parsed({"a.obj",      "b.obj",          "-o",    "out",      "--pe-bound", "0.7",           "--seams",
                                   "rectangles", "--cut",          "edges", "--omega",  "0.5",        "--until-input", "--gap-px",
                                   "4",          "--texture-size", "1024",  "--aspect", "2:1",        "--seed",        "9"});
  EXPECT_EQ(line.job, CommandLine::Job::Refine);
  EXPECT_EQ(line.output_of(1), std::filesystem::path("out") / "b.obj");
  EXPECT_EQ(line.options.pe_bound, 0.7);
  EXPECT_EQ(line.options.seams, Seams::Rectangles);
  EXPECT_EQ(line.options.cut, Cut::Edges);
  EXPECT_EQ(line.options.rectangles.omega, 0.5);
  EXPECT_TRUE(line.options.rectangles.until_input);
  EXPECT_EQ(line.options.gap->value, 4.0 / 1024);
  EXPECT_EQ(line.options.gap->unit, Gap::Unit::LongSide);
  EXPECT_EQ(line.options.box_aspect, 2);
  EXPECT_EQ(line.options.seed, 9);
}

TEST(CommandLine, TheAspectHasEnds) {
  EXPECT_EQ(parsed({"measure", "a.obj", "--aspect", "1:100"}).options.box_aspect, 0.01);
  EXPECT_EQ(parsed({"measure", "a.obj", "--aspect", "100:1"}).options.box_aspect, 100);
  EXPECT_EQ(refusal({"measure", "a.obj", "--aspect", "100.1:1"}), "--aspect: must lie between 1:100 and 100:1, not '100.1:1'");
  EXPECT_EQ(refusal({"measure", "a.obj", "--aspect", "1:100.1"}), "--aspect: must lie between 1:100 and 100:1, not '1:100.1'");
}

TEST(CommandLine, CutsSplitFacesUnlessSaidOtherwise) {
  EXPECT_EQ(parsed({"a.obj", "-o", "b.obj"}).options.cut, Cut::Split);
  EXPECT_EQ(parsed({"a.obj", "-o", "b.obj", "--cut", "split"}).options.cut, Cut::Split);
  EXPECT_EQ(refusal({"a.obj", "-o", "b.obj", "--cut", "around"}), "--cut: must be 'split' or 'edges', not 'around'");
}

TEST(CommandLine, WhatOnlyRectanglesReadNeedsThem) {
  EXPECT_EQ(refusal({"a.obj", "-o", "b.obj", "--until-input"}), "--until-input: needs --seams rectangles");
  EXPECT_EQ(refusal({"a.obj", "-o", "b.obj", "--until-input", "--sigma", "0.01"}), "--sigma: needs --seams rectangles");
  EXPECT_EQ(refusal({"a.obj", "-o", "b.obj", "--seams", "rectangles", "--sigma", "0.01"}), "accepted");
}

TEST(CommandLine, OptionsThatDoNotFitTogetherAreRefused) {
  EXPECT_EQ(refusal({"a.obj", "-o", "b.obj", "--gap", "0.01", "--gap-px", "4", "--texture-size", "512"}),
            "--gap-px: cannot be combined with --gap");
  EXPECT_EQ(refusal({"a.obj", "-o", "b.obj", "--texture-size", "512"}), "--texture-size: needs --gap-px");
  EXPECT_EQ(refusal({"x/a.obj", "y/a.obj", "-o", "out"}),
            "y/a.obj: a second file of this name, results would overwrite each other");
  EXPECT_EQ(refusal({"measure", "a.obj", "--json=no"}), "--json: takes no value");
  EXPECT_EQ(refusal({"a.obj", "-o", "b.obj", "--gap"}), "--gap: needs exactly one value");
  EXPECT_EQ(refusal({"a.obj", "--nonsense"}), "--nonsense: unknown option");
}

}  // namespace
}  // namespace atlas_refine::cli
