// What a refined atlas is held against: its charts' own optimum of E_d, and the cost of one Newton iteration with stock Eigen.
//
//   atlas_refine_bench IN.obj [RESULT.obj WIDTH GAP box_diagonal|long_side]... [RESULT.obj WIDTH newton only]...
//
// WIDTH is width / height of the texture that [0, 1]^2 of the result is. GAP is the gap that the result keeps, as its report has
// it; of a result that was cut only the Newton iteration is timed. Prints one line of JSON.
#include <Eigen/SparseCholesky>
#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <functional>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "input/split_charts.h"
#include "io/mesh_file.h"
#include "measure/certificate.h"
#include "measure/distortion.h"
#include "reduce/goal.h"
#include "reduce/reduce.h"
#include "repair/repair_charts.h"
#include "solve/symmetric_dirichlet.h"

namespace atlas_refine {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kNewtonRuns = 3;
constexpr double kDamping = 1e-3;  // the charts are free to move rigidly

/// Processor time, which other programs on the machine do not lengthen.
double cpu_seconds() {
  timespec now;
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// The charts of a file, each scaled to its own optimum of E_d.
struct Charts {
  std::vector<Chart> charts;
  std::vector<double> scales;  // that were applied

  explicit Charts(const std::string& path, double texture_width = 1) {
    const auto file = io::read_mesh_file(path);
    ChartSet set = split_charts(file->atlas());
    for (Chart& chart : set.charts) {
      for (Vec2& uv : chart.uvs) uv.x() *= texture_width;
    }
    file_box = uv_box(set.charts).size();
    charts = std::move(set.charts);
    for (const Chart& chart : charts) scales.push_back(dirichlet_sums(chart).best_scale());
    set_density(charts, wanted_density(charts, Density::Equal), Density::Equal);
  }
  Vec2 file_box;
};

/// E_d of all charts, each first taken to its own optimum.
double energy_of_optima(const std::vector<Chart>& charts, const std::function<Chart(int)>& optimum) {
  DirichletSums sums;
  for (int c = 0; c < static_cast<int>(charts.size()); ++c) {
    std::vector<Chart> alone = {optimum(c)};
    set_density(alone, wanted_density(alone, Density::Equal), Density::Equal);
    sums += dirichlet_sums(alone);
  }
  return sums.best_energy();
}

/// One chart under the engine without a box; `gap` of its own box.
Chart relaxed(const Chart& chart, const Gap& gap) {
  const std::vector<Chart> start = {chart};
  Chart out = chart;
  out.uvs = reduce_distortion({.charts = start, .gap = gap}).uvs[0];
  return out;
}

/// From the input: charts that are not valid are mended, as refine() does it.
double optimum_from_input(const Charts& input) {
  Monitor monitor;
  return energy_of_optima(input.charts, [&](int c) {
    const bool valid = certify_charts({input.charts[c]}).valid();
    return valid ? relaxed(input.charts[c], Gap{}) : repair_charts({input.charts[c]}, {}, monitor).atlas.pieces.front().mesh;
  });
}

/// From a result: each chart keeps, in open space, the absolute gap that it kept in the atlas.
double optimum_from_result(const Charts& result, const Gap& gap) {
  const double length = gap.length(result.file_box);
  return energy_of_optima(result.charts, [&](int c) {
    const double own_diagonal = uv_box({result.charts[c]}).diagonal();
    return relaxed(result.charts[c], {length * result.scales[c] / own_diagonal, Gap::Unit::BoxDiagonal});
  });
}

/// Hessian of E_d with respect to all UV vertices, two rows each.
Eigen::SparseMatrix<double> hessian(const std::vector<Chart>& charts, Eigen::VectorXd& gradient) {
  std::vector<Eigen::Triplet<double>> triplets;
  int first = 0;
  for (const Chart& chart : charts) first += chart.vertex_count();
  gradient = Eigen::VectorXd::Zero(Eigen::Index{2} * first);
  first = 0;
  const auto add = [&](int i, int j, const Mat2& block) {
    for (int row = 0; row < 2; ++row) {
      for (int column = 0; column < 2; ++column) triplets.emplace_back(2 * i + row, 2 * j + column, block(row, column));
    }
  };
  for (const Chart& chart : charts) {
    for (std::size_t t = 0; t < chart.triangles.size(); ++t) {
      const Triangle& v = chart.triangles[t];
      const double weight = chart.surface[t].area;
      const TriangleDerivatives d =
          symmetric_dirichlet_derivatives(chart.surface[t].inverse_edges, chart.uvs[v[0]], chart.uvs[v[1]], chart.uvs[v[2]]);
      for (int k = 0; k < 3; ++k) {
        const int i = first + v[k], j = first + v[(k + 1) % 3];
        gradient.segment<2>(Eigen::Index{2} * i) += weight * d.gradient[k];
        add(i, i, weight * (d.diagonal[k] + kDamping / 3 * Mat2::Identity()));
        add(i, j, weight * d.off_diagonal[k]);
        add(j, i, weight * d.off_diagonal[k].transpose());
      }
    }
    first += chart.vertex_count();
  }
  Eigen::SparseMatrix<double> matrix(Eigen::Index{2} * first, Eigen::Index{2} * first);
  matrix.setFromTriplets(triplets.begin(), triplets.end());
  return matrix;
}

/// Triplets, order, factor, solve: the median time of a Newton iteration on E_d alone.
Json stock_newton(const std::vector<Chart>& charts) {
  std::array<double, kNewtonRuns> seconds;
  for (double& run : seconds) {
    const double start = cpu_seconds();
    Eigen::VectorXd gradient;
    const Eigen::SparseMatrix<double> matrix = hessian(charts, gradient);
    const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> solver(matrix);
    const Eigen::VectorXd step = solver.solve(gradient);
    run = cpu_seconds() - start;
    if (solver.info() != Eigen::Success || !step.allFinite()) return {{"error", "the stock solver failed"}};
  }
  std::sort(seconds.begin(), seconds.end());
  return {{"newton_seconds", seconds[kNewtonRuns / 2]}};
}

/// `work`'s answer, or what went wrong.
Json attempt(const std::function<Json()>& work) {
  try {
    return work();
  } catch (const std::exception& error) {
    return {{"error", error.what()}};
  }
}

Json compare(const std::string& path, double texture_width, const std::optional<Gap>& gap) {
  const Charts result(path, texture_width);
  Json out = stock_newton(result.charts);
  if (gap) out["optimum"] = optimum_from_result(result, *gap);
  return out;
}

/// What the command line says about a result: GAP and its unit, or "newton only".
std::optional<Gap> gap_of(const std::string& value, const std::string& unit) {
  if (value == "newton") return {};
  return Gap{std::atof(value.c_str()), unit == "box_diagonal" ? Gap::Unit::BoxDiagonal : Gap::Unit::LongSide};
}

}  // namespace
}  // namespace atlas_refine

int main(int argc, char** argv) {
  using namespace atlas_refine;
  if (argc < 2 || (argc - 2) % 4 != 0) {
    std::fputs("usage: atlas_refine_bench IN.obj [RESULT.obj WIDTH (GAP box_diagonal|long_side | newton only)]...\n", stderr);
    return 2;
  }
  bool any_gap = argc == 2;
  Json results = Json::array();
  for (int i = 2; i < argc; i += 4) {
    const std::optional<Gap> gap = gap_of(argv[i + 2], argv[i + 3]);
    any_gap = any_gap || gap;
    results.push_back(attempt([&] { return compare(argv[i], std::atof(argv[i + 1]), gap); }));
  }
  Json out;
  out["input"] = any_gap ? attempt([&] { return Json{{"optimum", optimum_from_input(Charts(argv[1]))}}; }) : Json::object();
  out["results"] = results;
  std::puts(out.dump(-1, ' ', false, Json::error_handler_t::replace).c_str());
  return 0;
}
