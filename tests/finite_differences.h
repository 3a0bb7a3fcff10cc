// One checker for every energy: analytic gradient and Hessian against central differences.
#pragma once

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <functional>

namespace atlas_refine::testing {

using Energy = std::function<double(const Eigen::VectorXd&)>;

inline Eigen::VectorXd numeric_gradient(const Energy& energy, const Eigen::VectorXd& x, double h = 1e-6) {
  Eigen::VectorXd g(x.size());
  for (int i = 0; i < x.size(); ++i) {
    Eigen::VectorXd a = x, b = x;
    a[i] += h;
    b[i] -= h;
    g[i] = (energy(a) - energy(b)) / (2 * h);
  }
  return g;
}

/// From the analytic gradient, which is the smoother route.
inline Eigen::MatrixXd numeric_hessian(const std::function<Eigen::VectorXd(const Eigen::VectorXd&)>& gradient,
                                       const Eigen::VectorXd& x, double h = 1e-6) {
  Eigen::MatrixXd m(x.size(), x.size());
  for (int i = 0; i < x.size(); ++i) {
    Eigen::VectorXd a = x, b = x;
    a[i] += h;
    b[i] -= h;
    m.col(i) = (gradient(a) - gradient(b)) / (2 * h);
  }
  return m;
}

inline void expect_close(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b, double relative) {
  const double scale = std::max({a.cwiseAbs().maxCoeff(), b.cwiseAbs().maxCoeff(), 1e-12});
  EXPECT_LE((a - b).cwiseAbs().maxCoeff(), relative * scale) << "analytic\n" << a << "\nnumeric\n" << b;
}

}  // namespace atlas_refine::testing
