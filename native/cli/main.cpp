// The program atlas-refine: an OBJ file in, the same file with a better atlas out.
#include <chrono>
#include <cstdio>
#include <exception>
#include <memory>
#include <string>
#include <system_error>

#include "atlas_refine/refine.h"
#include "command_line.h"
#include "interrupt.h"
#include "obj_file.h"
#include "output_file.h"
#include "progress_bar.h"
#include "report.h"

namespace atlas_refine::cli {

namespace {

enum Exit { exit_done = 0, exit_internal_error = 1, exit_usage = 2, exit_bad_input = 3, exit_bound_not_reached = 4 };

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// Errors are exactly one line: `atlas-refine: <thing>: <what is wrong>`.
int complain(const std::string& message, int exit_code) {
  std::string line = "atlas-refine: " + message;
  for (char& c : line) c = c == '\n' || c == '\r' ? ' ' : c;
  std::fprintf(stderr, "%s\n", line.c_str());
  return exit_code;
}

int exit_code_of(ErrorCode code) {
  switch (code) {
    case ErrorCode::BadOption:
      return exit_usage;
    case ErrorCode::BadInput:
      return exit_bad_input;
    case ErrorCode::BoundNotReached:
    case ErrorCode::NotCertified:
      return exit_bound_not_reached;
    case ErrorCode::Cancelled:
      return exit_interrupted;
  }
  return exit_internal_error;
}

/// Names the file, and the line where the library names a face.
int complain(const CommandLine& line, const RefineError& error, const ObjFile* file) {
  if (error.code() == ErrorCode::Cancelled) return exit_interrupted;
  if (error.code() == ErrorCode::BadOption) return complain(error.what(), exit_usage);
  std::string where = line.input.string() + ": ";
  if (file && error.face() >= 0 && error.face() < file->atlas().face_count())
    where += "line " + std::to_string(file->line_of_face(error.face())) + ": ";
  return complain(where + error.what(), exit_code_of(error.code()));
}

void check_outputs(const CommandLine& line) {
  check_writable(line.output);
  if (line.report) {
    check_writable(*line.report);
    if (same_file(*line.report, line.output))
      throw OutputError(*line.report, "is the output already, not a place for the report");
    if (same_file(*line.report, line.input)) throw OutputError(*line.report, "is the input, not a place for the report");
  }
  if (line.svg_folder) check_folder_creatable(*line.svg_folder);
}

std::unique_ptr<DebugSink> pictures(const CommandLine& line) {
  if (!line.svg_folder) return nullptr;
  std::error_code error;
  std::filesystem::create_directory(*line.svg_folder, error);
  if (error) throw OutputError(*line.svg_folder, "cannot be created: " + error.message());
  return svg_sink(*line.svg_folder);
}

RefineResult refine_with_progress(const Atlas& atlas, const RefineOptions& options, DebugSink* debug) {
  ProgressBar bar;
  const auto report_progress = [&bar](const Progress& progress) {
    bar.show(progress);
    return !interrupted();
  };
  return refine(atlas, options, report_progress, debug);
}

/// The result and the report appear together, or neither does.
void write_outputs(const CommandLine& line, const ObjFile& file, const RefineResult& result, Times& times) {
  const InterruptScope ask(OnInterrupt::Ask);
  const auto start = std::chrono::steady_clock::now();
  const bool unchanged = result.intervention == Intervention::Unchanged;
  PendingFile output(line.output, unchanged ? file.text() : file.text_with_uvs(result.corner_uvs));
  times.write = seconds_since(start);
  std::unique_ptr<PendingFile> report;
  if (line.report) report = std::make_unique<PendingFile>(*line.report, json_report(line, result, times));
  if (interrupted()) throw RefineError(ErrorCode::Cancelled, "write", "cancelled");
  output.commit();
  if (report) report->commit();
}

int run_refine(const CommandLine& line) {
  check_outputs(line);
  std::unique_ptr<ObjFile> file;
  try {
    Times times;
    auto start = std::chrono::steady_clock::now();
    file = std::make_unique<ObjFile>(ObjFile::read(line.input));
    times.read = seconds_since(start);

    const InterruptScope ask_and_exit(OnInterrupt::AskAndExit);
    const auto debug = pictures(line);
    start = std::chrono::steady_clock::now();
    const RefineResult result = refine_with_progress(file->atlas(), line.options, debug.get());
    times.refine = seconds_since(start);
    write_outputs(line, *file, result, times);
    std::fputs(summary(result, times).c_str(), stdout);
    return exit_done;
  } catch (const RefineError& error) {
    return complain(line, error, file.get());
  }
}

int run_measure(const CommandLine& line) {
  std::unique_ptr<ObjFile> file;
  try {
    file = std::make_unique<ObjFile>(ObjFile::read(line.input));
    const Measures measures = measure(file->atlas(), line.options.box_aspect);
    const Validity validity = validate(file->atlas());
    const std::string text =
        line.json ? measures_json(line.input.string(), measures, validity) : measures_table(measures, validity);
    std::fputs(text.c_str(), stdout);
    return exit_done;
  } catch (const RefineError& error) {
    return complain(line, error, file.get());
  }
}

int run(int argc, char** argv) {
  const CommandLine line = parse_command_line(argc, argv);
  switch (line.job) {
    case CommandLine::Job::Refine:
      return run_refine(line);
    case CommandLine::Job::Measure:
      return run_measure(line);
    case CommandLine::Job::PrintText:
      std::fputs(line.text.c_str(), stdout);
      return exit_done;
  }
  return exit_internal_error;
}

}  // namespace

}  // namespace atlas_refine::cli

int main(int argc, char** argv) {
  using namespace atlas_refine::cli;
  install_interrupt_handler();
  try {
    return run(argc, argv);
  } catch (const UsageError& error) {
    return complain(error.what(), exit_usage);
  } catch (const OutputError& error) {
    return complain(error.path.string() + ": " + error.what(), exit_usage);
  } catch (const std::exception& error) {
    return complain(std::string("internal error: ") + error.what(), exit_internal_error);
  }
}
