// Mehrotra's predictor-corrector method on the normal equations: min c.z, A z -
// s = b, s >= 0, -reach <= z <= reach.
#include "pack/linear_program.h"

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>
#include <numeric>

namespace atlas_refine {
namespace {

using Eigen::VectorXd;

/// A: the inequalities given, those of the same variables together, then z_i >= -reach_i, then -z_i >= -reach_i.
class Rows {
 public:
  Rows(std::vector<LinearInequality> given, const VectorXd& reach)
      : m_(static_cast<int>(given.size())), n_(static_cast<int>(reach.size())), bounds_(m_ + 2 * n_) {
    for (LinearInequality& row : given) {
      std::sort(row.terms.begin(), row.terms.end(), [](const Term& a, const Term& b) { return a.variable < b.variable; });
    }
    std::vector<int> order(given.size());
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return before(given[a], given[b]); });
    for (const int k : order) add(given[k]);
    bounds_.segment(m_, n_) = bounds_.tail(n_) = -reach;
  }

  const VectorXd& bounds() const { return bounds_; }

  VectorXd times(const VectorXd& z) const {
    VectorXd product(m_ + 2 * n_);
    for (const Block& block : blocks_) {
      const double* coefficient = &coefficients_[block.coefficients];
      const int* variable = &variables_[block.variables];
      for (int k = block.begin; k < block.end; ++k, coefficient += block.width) {
        double sum = 0;
        for (int i = 0; i < block.width; ++i) sum += coefficient[i] * z[variable[i]];
        product[k] = sum;
      }
    }
    product.segment(m_, n_) = z;
    product.tail(n_) = -z;
    return product;
  }

  VectorXd transposed_times(const VectorXd& y) const {
    VectorXd product = y.segment(m_, n_) - y.tail(n_);
    VectorXd sums(widest_);
    for (const Block& block : blocks_) {
      const double* coefficient = &coefficients_[block.coefficients];
      sums.setZero();
      for (int k = block.begin; k < block.end; ++k, coefficient += block.width) {
        for (int i = 0; i < block.width; ++i) sums[i] += coefficient[i] * y[k];
      }
      for (int i = 0; i < block.width; ++i) product[variables_[block.variables + i]] += sums[i];
    }
    return product;
  }

  /// Rows [begin, end), all of the same variables.
  struct Block {
    int begin, end;
    int width;                    ///< variables
    std::size_t variables;        ///< the first in variables_, in rising order
    std::ptrdiff_t coefficients;  ///< the first in coefficients_, row by row
  };

  int variables() const { return n_; }
  int given() const { return m_; }
  int widest() const { return widest_; }
  const std::vector<Block>& blocks() const { return blocks_; }
  int variable(const Block& block, int i) const { return variables_[block.variables + i]; }

  /// The sum of each two coefficients of a row times its weight, over the block's rows; width x width.
  void sum_squares(const Block& block, const VectorXd& weight, double* sums) const {
    std::fill_n(sums, block.width * block.width, 0.0);
    const double* row = &coefficients_[block.coefficients];
    for (int k = block.begin; k < block.end; ++k, row += block.width) {
      for (int i = 0; i < block.width; ++i) {
        const double scaled = weight[k] * row[i];
        for (int j = 0; j < block.width; ++j) sums[i * block.width + j] += scaled * row[j];
      }
    }
  }

 private:
  using Term = LinearInequality::Term;

  static bool before(const LinearInequality& a, const LinearInequality& b) {
    return std::lexicographical_compare(a.terms.begin(), a.terms.end(), b.terms.begin(), b.terms.end(),
                                        [](const Term& p, const Term& q) { return p.variable < q.variable; });
  }

  void add(const LinearInequality& row) {
    const int number = blocks_.empty() ? 0 : blocks_.back().end, width = static_cast<int>(row.terms.size());
    const auto same = [](int variable, const Term& term) { return variable == term.variable; };
    if (blocks_.empty() || !std::equal(variables_.begin() + static_cast<std::ptrdiff_t>(blocks_.back().variables),
                                       variables_.end(), row.terms.begin(), row.terms.end(), same)) {
      blocks_.push_back({number, number, width, variables_.size(), static_cast<std::ptrdiff_t>(coefficients_.size())});
      for (const Term& term : row.terms) variables_.push_back(term.variable);
      widest_ = std::max(widest_, width);
    }
    blocks_.back().end = number + 1;
    for (const Term& term : row.terms) coefficients_.push_back(term.coefficient);
    bounds_[number] = row.bound;
  }

  int m_, n_, widest_ = 0;
  VectorXd bounds_;
  std::vector<Block> blocks_;
  std::vector<int> variables_;
  std::vector<double> coefficients_;
};

/// A' diag(weight) A, its lower triangle.
class NormalMatrix {
 public:
  explicit NormalMatrix(const Rows& rows)
      : rows_(rows), matrix_(rows.variables(), rows.variables()), sums_(rows.widest() * rows.widest()) {
    std::vector<Eigen::Triplet<double>> entries;
    for (const auto& block : rows.blocks()) {
      for (int i = 0; i < block.width; ++i) {
        for (int j = 0; j <= i; ++j) entries.emplace_back(rows.variable(block, i), rows.variable(block, j), 1);
      }
    }
    for (int i = 0; i < rows.variables(); ++i) entries.emplace_back(i, i, 1);
    matrix_.setFromTriplets(entries.begin(), entries.end());
    slots_.reserve(entries.size());
    for (const auto& entry : entries) {
      const int* begin = matrix_.innerIndexPtr() + matrix_.outerIndexPtr()[entry.col()];
      const int* end = matrix_.innerIndexPtr() + matrix_.outerIndexPtr()[entry.col() + 1];
      slots_.push_back(static_cast<int>(std::lower_bound(begin, end, entry.row()) - matrix_.innerIndexPtr()));
    }
  }

  const Eigen::SparseMatrix<double>& weighted_with(const VectorXd& weight) {
    double* values = matrix_.valuePtr();
    std::fill_n(values, matrix_.nonZeros(), 0.0);
    const int* slot = slots_.data();
    for (const auto& block : rows_.blocks()) {
      rows_.sum_squares(block, weight, sums_.data());
      for (int i = 0; i < block.width; ++i) {
        for (int j = 0; j <= i; ++j) values[*slot++] += sums_[i * block.width + j];
      }
    }
    const int m = rows_.given(), n = rows_.variables();
    for (int i = 0; i < n; ++i) values[*slot++] += weight[m + i] + weight[m + n + i];
    return matrix_;
  }

 private:
  const Rows& rows_;
  Eigen::SparseMatrix<double> matrix_;
  VectorXd sums_;           ///< of one block
  std::vector<int> slots_;  ///< for each pair of terms of a block, in the order they are summed, its place in the matrix
};

/// Largest step in (0, 1] that keeps x + step * dx >= 0.
double step_to_boundary(const VectorXd& x, const VectorXd& dx) {
  double step = 1;
  for (int k = 0; k < x.size(); ++k) {
    if (dx[k] < 0) step = std::min(step, -x[k] / dx[k]);
  }
  return step;
}

using Solver = Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>>;

/// Values of the variables, the rows' slacks and their multipliers; or a step in them.
struct Iterate {
  VectorXd z, slack, dual;

  /// Mean product of a slack and its multiplier: 0 at the optimum.
  double gap() const { return slack.dot(dual) / static_cast<double>(slack.size()); }
};

/// What is missing from A z - s = b and A' l = c.
struct Residuals {
  VectorXd primal, dual;
};

/// Newton on A dz - ds = -rp, A' dl = -rd, S dl + L ds = complementarity. `solver` holds A' diag(weight) A.
Iterate newton_step(const Rows& rows, const Solver& solver, const Iterate& at, const Residuals& residuals,
                    const VectorXd& complementarity) {
  const VectorXd weight = at.dual.cwiseQuotient(at.slack);
  const VectorXd inner = complementarity.cwiseQuotient(at.slack) - weight.cwiseProduct(residuals.primal);
  Iterate step;
  step.z = solver.solve(rows.transposed_times(inner) - residuals.dual);
  step.slack = rows.times(step.z) + residuals.primal;
  step.dual = complementarity.cwiseQuotient(at.slack) - weight.cwiseProduct(step.slack);
  return step;
}

/// A step straight at the optimum tells how much to centre the one that is taken, and its second-order error.
Iterate predictor_corrector_step(const Rows& rows, const Solver& solver, const Iterate& at, const Residuals& residuals) {
  const VectorXd product = at.slack.cwiseProduct(at.dual);
  const Iterate affine = newton_step(rows, solver, at, residuals, -product);
  const double primal = step_to_boundary(at.slack, affine.slack), dual = step_to_boundary(at.dual, affine.dual);
  const Iterate reached{{}, at.slack + primal * affine.slack, at.dual + dual * affine.dual};
  const double gap = at.gap(), centring = std::pow(reached.gap() / gap, 3);
  return newton_step(rows, solver, at, residuals,
                     VectorXd::Constant(product.size(), centring * gap) - product - affine.slack.cwiseProduct(affine.dual));
}

}  // namespace

VectorXd solve_linear_program(const VectorXd& cost, const std::vector<LinearInequality>& inequalities, const VectorXd& reach,
                              const std::function<void()>& poll) {
  constexpr int kIterations = 60;
  constexpr double kPrecision = 1e-9;
  const Rows rows(inequalities, reach);
  NormalMatrix normal(rows);
  const double scale = reach.maxCoeff(), price = std::max(cost.lpNorm<Eigen::Infinity>(), 1e-300);
  Iterate at{VectorXd::Zero(cost.size()), (-rows.bounds()).cwiseMax(0.1 * scale), {}};
  at.dual = VectorXd::Constant(at.slack.size(), price);
  Solver solver;
  for (int iteration = 0; iteration < kIterations; ++iteration) {
    poll();
    const Residuals residuals{rows.times(at.z) - at.slack - rows.bounds(), cost - rows.transposed_times(at.dual)};
    if (residuals.primal.lpNorm<Eigen::Infinity>() < kPrecision * scale &&
        residuals.dual.lpNorm<Eigen::Infinity>() < 1e-7 * price && at.gap() * at.slack.size() < 1e-4 * price * scale) {
      return at.z;
    }
    const auto& matrix = normal.weighted_with(at.dual.cwiseQuotient(at.slack));
    if (iteration == 0) solver.analyzePattern(matrix);
    solver.factorize(matrix);
    if (solver.info() != Eigen::Success) return {};
    const Iterate step = predictor_corrector_step(rows, solver, at, residuals);
    const double primal = std::min(1.0, 0.99 * step_to_boundary(at.slack, step.slack));
    const double dual = std::min(1.0, 0.99 * step_to_boundary(at.dual, step.dual));
    at.z += primal * step.z;
    at.slack += primal * step.slack;
    at.dual += dual * step.dual;
  }
  return {};
}

}  // namespace atlas_refine
