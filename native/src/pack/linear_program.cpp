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

}  // namespace

VectorXd solve_linear_program(const VectorXd& cost, const std::vector<LinearInequality>& inequalities, const VectorXd& reach,
                              const std::function<void()>& poll) {
  constexpr int kIterations = 60;
  constexpr double kPrecision = 1e-9;
  Rows rows(inequalities, reach);
  const double scale = reach.maxCoeff(), price = std::max(cost.lpNorm<Eigen::Infinity>(), 1e-300);
  VectorXd z = VectorXd::Zero(cost.size());
  VectorXd slack = (-rows.bounds()).cwiseMax(0.1 * scale);
  VectorXd dual = VectorXd::Constant(slack.size(), price);
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> solver;
  for (int iteration = 0; iteration < kIterations; ++iteration) {
    poll();
    const VectorXd primal_residual = rows.times(z) - slack - rows.bounds();
    const VectorXd dual_residual = cost - rows.transposed_times(dual);
    const double gap = slack.dot(dual) / slack.size();
    if (primal_residual.lpNorm<Eigen::Infinity>() < kPrecision * scale &&
        dual_residual.lpNorm<Eigen::Infinity>() < 1e-7 * price && gap * slack.size() < 1e-4 * price * scale) {
      return z;
    }
    const VectorXd weight = dual.cwiseQuotient(slack);
    const auto& normal = rows.normal(weight);
    if (iteration == 0) solver.analyzePattern(normal);
    solver.factorize(normal);
    if (solver.info() != Eigen::Success) return {};
    // Newton on A dz - ds = -rp, A' dl = rd, S dl + L ds = target - S l.
    VectorXd dz, ds, dl;
    const auto solve = [&](const VectorXd& complementarity) {
      const VectorXd inner = complementarity.cwiseQuotient(slack) - weight.cwiseProduct(primal_residual);
      dz = solver.solve(rows.transposed_times(inner) - dual_residual);
      ds = rows.times(dz) + primal_residual;
      dl = complementarity.cwiseQuotient(slack) - weight.cwiseProduct(ds);
    };
    solve(-slack.cwiseProduct(dual));
    const double affine_primal = step_to_boundary(slack, ds), affine_dual = step_to_boundary(dual, dl);
    const double affine_gap = (slack + affine_primal * ds).dot(dual + affine_dual * dl) / slack.size();
    const double centring = std::pow(affine_gap / gap, 3);
    solve((VectorXd::Constant(slack.size(), centring * gap) - slack.cwiseProduct(dual) - ds.cwiseProduct(dl)).eval());
    const double primal_step = std::min(1.0, 0.99 * step_to_boundary(slack, ds));
    const double dual_step = std::min(1.0, 0.99 * step_to_boundary(dual, dl));
    z += primal_step * dz;
    slack += primal_step * ds;
    dual += dual_step * dl;
  }
  return {};
}

}  // namespace atlas_refine
