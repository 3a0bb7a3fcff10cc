// Mehrotra's predictor-corrector method on the normal equations: min c.z, A z -
// s = b, s >= 0, -reach <= z <= reach.
#include "pack/linear_program.h"

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>

namespace atlas_refine {
namespace {

using Eigen::VectorXd;

/// A: the inequalities given, then z_i >= -reach_i, then -z_i >= -reach_i.
class Rows {
 public:
  Rows(const std::vector<LinearInequality>& given, const VectorXd& reach)
      : given_(given), m_(static_cast<int>(given.size())), n_(static_cast<int>(reach.size())), bounds_(m_ + 2 * n_) {
    for (int k = 0; k < m_; ++k) bounds_[k] = given[k].bound;
    bounds_.segment(m_, n_) = bounds_.tail(n_) = -reach;
    prepare_normal();
  }

  const VectorXd& bounds() const { return bounds_; }

  VectorXd times(const VectorXd& z) const {
    VectorXd product(m_ + 2 * n_);
    for (int k = 0; k < m_; ++k) {
      double sum = 0;
      for (const auto& term : given_[k].terms) sum += term.coefficient * z[term.variable];
      product[k] = sum;
    }
    product.segment(m_, n_) = z;
    product.tail(n_) = -z;
    return product;
  }

  VectorXd transposed_times(const VectorXd& y) const {
    VectorXd product = y.segment(m_, n_) - y.tail(n_);
    for (int k = 0; k < m_; ++k) {
      for (const auto& term : given_[k].terms) product[term.variable] += term.coefficient * y[k];
    }
    return product;
  }

  /// Lower triangle of A' diag(weight) A.
  const Eigen::SparseMatrix<double>& normal(const VectorXd& weight) {
    double* values = normal_.valuePtr();
    std::fill_n(values, normal_.nonZeros(), 0.0);
    const int* slot = slots_.data();
    for (int k = 0; k < m_; ++k) {
      for (const auto& p : given_[k].terms) {
        const double scaled = weight[k] * p.coefficient;
        for (const auto& q : given_[k].terms) {
          if (q.variable <= p.variable) values[*slot++] += scaled * q.coefficient;
        }
      }
    }
    for (int i = 0; i < n_; ++i) values[*slot++] += weight[m_ + i] + weight[m_ + n_ + i];
    return normal_;
  }

 private:
  void prepare_normal() {
    std::vector<Eigen::Triplet<double>> entries;
    for (const auto& row : given_) {
      for (const auto& p : row.terms) {
        for (const auto& q : row.terms) {
          if (q.variable <= p.variable) entries.emplace_back(p.variable, q.variable, 1);
        }
      }
    }
    for (int i = 0; i < n_; ++i) entries.emplace_back(i, i, 1);
    normal_.resize(n_, n_);
    normal_.setFromTriplets(entries.begin(), entries.end());
    slots_.reserve(entries.size());
    for (const auto& entry : entries) {
      const int* begin = normal_.innerIndexPtr() + normal_.outerIndexPtr()[entry.col()];
      const int* end = normal_.innerIndexPtr() + normal_.outerIndexPtr()[entry.col() + 1];
      slots_.push_back(static_cast<int>(std::lower_bound(begin, end, entry.row()) - normal_.innerIndexPtr()));
    }
  }

  const std::vector<LinearInequality>& given_;
  int m_, n_;
  VectorXd bounds_;
  Eigen::SparseMatrix<double> normal_;
  std::vector<int> slots_;  ///< for each pair of terms, in the order they are
                            ///< summed, its place in normal_
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
  Rows rows(inequalities, reach);
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
    const auto& normal = rows.normal(at.dual.cwiseQuotient(at.slack));
    if (iteration == 0) solver.analyzePattern(normal);
    solver.factorize(normal);
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
