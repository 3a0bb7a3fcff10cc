// One refine() in a thread of its own, which never touches Python: start, poll, cancel, result.
#include "job.h"

#include <pybind11/stl.h>

#include <algorithm>
#include <chrono>
#include <utility>
#include <vector>

namespace py = pybind11;

namespace atlas_refine::python {
namespace {

std::mutex g_jobs_mutex;
std::vector<Job*> g_jobs;  // those alive, for stop_all()

}  // namespace

Job::Job(Atlas atlas, const RefineOptions& options) : atlas_(std::move(atlas)), options_(options), thread_([this] { run(); }) {
  const std::lock_guard lock(g_jobs_mutex);
  g_jobs.push_back(this);
}

Job::~Job() {
  {
    const std::lock_guard lock(g_jobs_mutex);
    std::erase(g_jobs, this);
  }
  stop();
}

void Job::stop() {
  cancel();
  if (thread_.joinable()) thread_.join();
}

void Job::stop_all() {
  const std::lock_guard lock(g_jobs_mutex);
  for (Job* job : g_jobs) job->cancel();
  for (Job* job : g_jobs) job->stop();
}

void Job::run() {
  const ProgressFn report = [this](const Progress& progress) -> Answer {
    const std::lock_guard lock(mutex_);
    progress_ = progress;
    return cancelled_ ? Answer::Cancel : finishing_ ? Answer::Finish : Answer::GoOn;
  };
  std::optional<RefineResult> result;
  std::exception_ptr error;
  try {
    result = refine(atlas_, options_, report);
  } catch (...) {
    error = std::current_exception();
  }
  const std::lock_guard lock(mutex_);
  result_ = std::move(result);
  error_ = error;
  if (result_) progress_ = {"done", 1.0, result_->after.pe_fixed_aspect};
  done_ = true;
  finished_.notify_all();
}

bool Job::done() const {
  const std::lock_guard lock(mutex_);
  return done_;
}

Progress Job::progress() const {
  const std::lock_guard lock(mutex_);
  return progress_;
}

bool Job::wait(double seconds) const {
  std::unique_lock lock(mutex_);
  if (seconds < 0) {
    finished_.wait(lock, [this] { return done_; });
    return true;
  }
  return finished_.wait_for(lock, std::chrono::duration<double>(seconds), [this] { return done_; });
}

const RefineResult& Job::result() const {
  wait(-1);
  if (error_) std::rethrow_exception(error_);
  return *result_;
}

namespace {

/// Ctrl-C ends the wait, not the job.
const RefineResult& wait_for_result(const Job& job) {
  for (bool done = false; !done;) {
    {
      const py::gil_scoped_release release;
      done = job.wait(0.1);
    }
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
  }
  return job.result();
}

}  // namespace

void bind_job(py::module_& module) {
  using ReleaseGil = py::call_guard<py::gil_scoped_release>;
  py::class_<Job>(module, "Job", py::module_local(), "A refine() that runs in the background; made by start().")
      .def_property_readonly("done", &Job::done, "True once result() returns at once.")
      .def_property_readonly("progress", &Job::progress, "The latest Progress; its stage is \"done\" once there is a result.")
      .def("cancel", &Job::cancel, "Asks the job to stop; returns at once, the job ends within half a second.")
      .def("finish", &Job::finish,
           "Asks the job for the best valid atlas so far; returns at once. Where that is not better than the input, result() is "
           "the "
           "input, unchanged. The result's `ended` is \"stopped\".")
      .def(
          "wait", [](const Job& job, std::optional<double> timeout) { return job.wait(timeout ? std::max(*timeout, 0.0) : -1); },
          py::arg("timeout") = py::none(), ReleaseGil(),
          "Waits at most `timeout` seconds (None: no limit); True where the job is done.")
      .def("result", &wait_for_result, py::return_value_policy::copy,
           "Waits for the end and returns the RefineResult; raises AtlasRefineError as refine() does.");
  py::module_::import("atexit").attr("register")(py::cpp_function(&Job::stop_all, ReleaseGil()));
}

}  // namespace atlas_refine::python
