#include "solution/mass_projection.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "solution/clipped_tetrahedra.h"

namespace tetrafront {
namespace {

/// Residual / right-hand side at which the search ends; the integral then lacks less than this.
constexpr double kProjectionTolerance = 1e-15;
constexpr int kProjectionSteps = 200;

/// Elements per unit of work in one product with the mass matrix.
constexpr std::size_t kProductsPerUnit = 32;

double dotOf(std::span<const double> a, std::span<const double> b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
  return sum;
}

}  // namespace

MassProjection::MassProjection(const VolumeMesh& mesh, std::size_t components)
    : mesh_(&mesh),
      components_(components),
      integrals_(components * countNodes(mesh), 0.0),
      volumes_(countTetrahedra(mesh)),
      diagonal_(countNodes(mesh), 0.0) {
  for (std::size_t t = 0; t < volumes_.size(); ++t) {
    volumes_[t] = volumeWithin(cornersOf(mesh, TetId(t)));
    for (const NodeId node : nodesOf(mesh, TetId(t))) diagonal_[node.index()] += volumes_[t] / 10.0;
  }
}

void MassProjection::add(TetId tet, std::span<const double> integrals) {
  std::size_t slot = 0;
  for (const NodeId node : nodesOf(*mesh_, tet)) {
    for (std::size_t c = 0; c < components_; ++c)
      integrals_[components_ * node.index() + c] += integrals[slot++];
  }
}

void MassProjection::multiply(std::span<const double> values, std::vector<double>& products) const {
  std::ranges::fill(products, 0.0);
  for (std::size_t t = 0; t < volumes_.size(); ++t) {
    const auto [a, b, c, d] = nodesOf(*mesh_, TetId(t));
    const double sum =
        (values[a.index()] + values[b.index()]) + (values[c.index()] + values[d.index()]);
    for (const NodeId node : {a, b, c, d})
      products[node.index()] += volumes_[t] / 20.0 * (sum + values[node.index()]);
  }
}

Task<std::vector<double>> MassProjection::solve(Work& work, std::vector<double> guess) {
  for (std::size_t c = 0; c < components_; ++c) {
    work.beginShare(1.0, static_cast<double>(components_ - c));
    co_await solveComponent(work, c, guess);
  }
  co_return guess;
}

/// Conjugate gradients with the diagonal as preconditioner. At the end, a constant is added that makes the integral exact.
Task<> MassProjection::solveComponent(Work& work, std::size_t component,
                                      std::vector<double>& values) {
  const std::size_t nodes = diagonal_.size();
  std::vector<double> x(nodes);
  std::vector<double> residual(nodes);
  std::vector<double> product(nodes);
  double scale = 0.0;
  for (std::size_t i = 0; i < nodes; ++i) {
    x[i] = values[components_ * i + component];
    const double integral = integrals_[components_ * i + component];
    if (diagonal_[i] > 0.0) scale += integral * integral / diagonal_[i];
  }
  const auto updateResidual = [&] {
    multiply(x, product);
    for (std::size_t i = 0; i < nodes; ++i)
      residual[i] = integrals_[components_ * i + component] - product[i];
  };
  updateResidual();
  std::vector<double> conditioned(nodes);
  const auto condition = [&] {
    for (std::size_t i = 0; i < nodes; ++i)
      conditioned[i] = diagonal_[i] > 0.0 ? residual[i] / diagonal_[i] : 0.0;
    return dotOf(residual, conditioned);
  };
  double rest = condition();
  std::vector<double> direction = conditioned;
  for (int step = 0; step < kProjectionSteps; ++step) {
    if (!(rest > kProjectionTolerance * kProjectionTolerance * scale)) break;
    multiply(direction, product);
    const double length = rest / dotOf(direction, product);
    for (std::size_t i = 0; i < nodes; ++i) {
      x[i] += length * direction[i];
      residual[i] -= length * product[i];
    }
    const double before = std::exchange(rest, condition());
    for (std::size_t i = 0; i < nodes; ++i)
      direction[i] = conditioned[i] + rest / before * direction[i];
    work.setFraction(std::min(0.9, 0.02 * step));
    co_await work.spend(1 + volumes_.size() / kProductsPerUnit);
  }
  updateResidual();
  double missing = 0.0;
  for (const double value : residual) missing += value;
  double total = 0.0;
  for (const double volume : volumes_) total += volume;
  for (std::size_t i = 0; i < nodes; ++i) {
    const double correction = diagonal_[i] > 0.0 ? missing / total : 0.0;
    values[components_ * i + component] = x[i] + correction;
  }
}

}  // namespace tetrafront
