#include "model/model_numbers.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "geom/coordinates.h"
#include "model/spline_basis.h"

namespace tetrafront {

namespace {

/// How far the length of an axis of a frame may be from 1: files have six digits or more. A damaged axis is much farther away.
constexpr double kAxisTolerance = 1e-6;

/// Reads numbers one after the other. After the end it returns zeros, and has failed.
class NumberReader {
 public:
  explicit NumberReader(std::span<const double> numbers) : rest_(numbers) {}

  [[nodiscard]] bool hasFailed() const { return hasFailed_; }

  double number() {
    if (rest_.empty()) {
      hasFailed_ = true;
      return 0.0;
    }
    const double value = rest_.front();
    rest_ = rest_.subspan(1);
    return value;
  }
  /// Reads a whole number below `limit`.
  std::uint32_t below(std::size_t limit) {
    const double value = number();
    if (value >= 0.0 && value < static_cast<double>(limit) && value == std::floor(value)) {
      return static_cast<std::uint32_t>(value);
    }
    hasFailed_ = true;
    return 0;
  }
  /// Reads how many items follow. Each needs at least one number, so there cannot be more than numbers are left.
  std::size_t count() { return below(rest_.size()); }
  bool flag() { return below(2) == 1; }
  /// Reads an index below `limit`, or none for -1.
  std::optional<std::uint32_t> indexOrNone(std::size_t limit) {
    std::optional<std::uint32_t> index;
    if (!skipNone()) index = below(limit);
    return index;
  }
  /// Reads the next number if it is -1.
  bool skipNone() {
    if (rest_.empty() || rest_.front() != -1.0) return false;
    rest_ = rest_.subspan(1);
    return true;
  }
  [[nodiscard]] bool isAtEnd() const { return rest_.empty(); }
  template <class Vector>
  Vector vector() {
    Vector result(0.0);
    for (glm::length_t k = 0; k < Vector::length(); ++k) result[k] = number();
    return result;
  }
  std::vector<double> list() {
    std::vector<double> result(count());
    for (double& value : result) value = number();
    return result;
  }
  template <class Vector>
  std::vector<Vector> vectors() {
    const std::size_t numbers = count();
    std::vector<Vector> result(numbers / Vector::length());
    for (Vector& each : result) each = vector<Vector>();
    if (result.size() * Vector::length() != numbers) hasFailed_ = true;
    return result;
  }

 private:
  std::span<const double> rest_;
  bool hasFailed_ = false;
};

template <class Curve>
void readCurve(NumberReader& reader, Curve& curve) {
  using Position = decltype(curve.frame.origin);
  curve.kind = static_cast<CurveKind>(reader.below(4));
  if (curve.kind == CurveKind::kBSpline) {
    curve.spline.degree = reader.below(kMaxDegree + 1);
    curve.spline.knots = reader.list();
    curve.spline.poles = reader.template vectors<Position>();
    curve.spline.weights = reader.list();
    return;
  }
  curve.frame.origin = reader.template vector<Position>();
  curve.frame.x = reader.template vector<Position>();
  curve.frame.y = reader.template vector<Position>();
  if constexpr (requires { curve.frame.z; }) curve.frame.z = reader.template vector<Position>();
  curve.radius = reader.number();
  curve.minorRadius = reader.number();
}

bool hasProfile(SurfaceKind kind) {
  return kind == SurfaceKind::kExtrusion || kind == SurfaceKind::kRevolution;
}

FaceSurface readSurface(NumberReader& reader) {
  FaceSurface surface;
  surface.kind = static_cast<SurfaceKind>(reader.below(8));
  if (surface.kind == SurfaceKind::kBSpline) {
    SplineSurface& spline = surface.spline;
    spline.uDegree = reader.below(kMaxDegree + 1);
    spline.vDegree = reader.below(kMaxDegree + 1);
    spline.uKnots = reader.list();
    spline.vKnots = reader.list();
    spline.poles = reader.vectors<Vec3>();
    spline.weights = reader.list();
    return surface;
  }
  surface.frame.origin = reader.vector<Vec3>();
  surface.frame.x = reader.vector<Vec3>();
  surface.frame.y = reader.vector<Vec3>();
  surface.frame.z = reader.vector<Vec3>();
  surface.radius = reader.number();
  surface.minorRadius = reader.number();
  surface.halfAngle = reader.number();
  if (hasProfile(surface.kind)) readCurve(reader, surface.profile);
  return surface;
}

/// Numbers of items of the models before the one that is read.
struct ModelOffsets {
  std::uint32_t vertices = 0;
  std::uint32_t curves = 0;
  std::uint32_t surfaces = 0;
  std::uint32_t edges = 0;
  std::uint32_t solids = 0;
};

template <class Items>
std::uint32_t countOf(const Items& items) {
  return static_cast<std::uint32_t>(items.size());
}

TrimmedEdge readEdge(NumberReader& reader, const TrimmedModel& model, const ModelOffsets& before) {
  TrimmedEdge edge;
  edge.curve = reader.indexOrNone(model.curves.size() - before.curves);
  if (edge.curve.has_value()) *edge.curve += before.curves;
  edge.first = reader.number();
  edge.last = reader.number();
  edge.start = before.vertices + reader.below(model.vertices.size() - before.vertices);
  edge.end = before.vertices + reader.below(model.vertices.size() - before.vertices);
  edge.tolerance = reader.number();
  return edge;
}

TrimmedFace readFace(NumberReader& reader, const TrimmedModel& model, const ModelOffsets& before) {
  TrimmedFace face;
  face.surface = before.surfaces + reader.below(model.surfaces.size() - before.surfaces);
  face.reversed = reader.flag();
  const std::size_t mostSolids = TrimmedFace::kNone - before.solids;
  face.solid = before.solids + reader.below(mostSolids);
  const std::optional<std::uint32_t> other = reader.indexOrNone(mostSolids);
  face.otherSolid = other.has_value() ? before.solids + *other : TrimmedFace::kNone;
  face.loops.resize(reader.count());
  for (std::vector<Coedge>& loop : face.loops) {
    loop.resize(reader.count());
    for (Coedge& coedge : loop) {
      coedge.edge = before.edges + reader.below(model.edges.size() - before.edges);
      coedge.reversed = reader.flag();
      if (!reader.skipNone()) readCurve(reader, coedge.inPlane.emplace());
    }
  }
  return face;
}

/// Appends a model to another one.
void appendModel(NumberReader& reader, TrimmedModel& model) {
  ModelOffsets before{.vertices = countOf(model.vertices),
                      .curves = countOf(model.curves),
                      .surfaces = countOf(model.surfaces),
                      .edges = countOf(model.edges)};
  for (const TrimmedFace& face : model.faces)
    before.solids = std::max(before.solids, face.solid + 1);
  const auto readAll = [&](auto& items, const auto& readOne) {
    const std::size_t first = items.size();
    items.resize(first + reader.count());
    for (std::size_t i = first; i < items.size() && !reader.hasFailed(); ++i) readOne(items[i]);
  };
  readAll(model.vertices, [&](Vec3& vertex) { vertex = reader.vector<Vec3>(); });
  readAll(model.curves, [&](SpaceCurve& curve) { readCurve(reader, curve); });
  readAll(model.surfaces, [&](FaceSurface& surface) { surface = readSurface(reader); });
  readAll(model.edges, [&](TrimmedEdge& edge) { edge = readEdge(reader, model, before); });
  readAll(model.faces, [&](TrimmedFace& face) { face = readFace(reader, model, before); });
}

// ---- what can be evaluated -----------------------------------------------------------------------

bool isPosition(double value) { return std::fabs(value) <= kLargestCoordinate; }

template <class Vector>
bool areCoordinates(const Vector& position) {
  for (glm::length_t k = 0; k < Vector::length(); ++k) {
    if (!isPosition(position[k])) return false;
  }
  return true;
}

template <class Vector>
bool isUnit(const Vector& axis) {
  return std::fabs(glm::length(axis) - 1.0) <= kAxisTolerance;
}

template <class Frame>
bool isValid(const Frame& frame) {
  if constexpr (requires { frame.z; }) {
    if (!isUnit(frame.z)) return false;
  }
  return areCoordinates(frame.origin) && isUnit(frame.x) && isUnit(frame.y);
}

/// Finite, ascending, with an interval that is not empty, and as many as the poles need.
bool areKnots(std::span<const double> knots, std::uint32_t degree) {
  if (knots.size() < 2 * (std::size_t{degree} + 1) || degree == 0) return false;
  return std::ranges::all_of(knots, isPosition) && std::ranges::is_sorted(knots) &&
         knots[degree] < knots[knots.size() - degree - 1];
}

bool areWeights(std::span<const double> weights, std::size_t poles) {
  return weights.empty() ||
         (weights.size() == poles && std::ranges::all_of(weights, [](double weight) {
            return weight > 0.0 && std::isfinite(weight);
          }));
}

template <class Vector>
bool arePoles(const std::vector<Vector>& poles, std::span<const double> weights,
              std::size_t count) {
  return poles.size() == count && std::ranges::all_of(poles, areCoordinates<Vector>) &&
         areWeights(weights, count);
}

template <class Curve>
bool isValidCurve(const Curve& curve) {
  if (curve.kind == CurveKind::kBSpline) {
    const auto& [degree, knots, poles, weights] = curve.spline;
    return areKnots(knots, degree) && arePoles(poles, weights, knots.size() - degree - 1);
  }
  // A line has no other axis.
  const bool hasFrame = curve.kind == CurveKind::kLine
                            ? areCoordinates(curve.frame.origin) && isUnit(curve.frame.x)
                            : isValid(curve.frame);
  return hasFrame && isPosition(curve.radius) && isPosition(curve.minorRadius);
}

bool isValidSurface(const FaceSurface& surface) {
  if (surface.kind == SurfaceKind::kBSpline) {
    const SplineSurface& spline = surface.spline;
    return areKnots(spline.uKnots, spline.uDegree) && areKnots(spline.vKnots, spline.vDegree) &&
           arePoles(spline.poles, spline.weights, spline.uCount() * spline.vCount());
  }
  return isValid(surface.frame) && isPosition(surface.radius) && isPosition(surface.minorRadius) &&
         std::isfinite(surface.halfAngle) &&
         (!hasProfile(surface.kind) || isValidCurve(surface.profile));
}

bool isValidEdge(const TrimmedModel& model, const TrimmedEdge& edge) {
  const bool hasRange = isPosition(edge.first) && isPosition(edge.last) && edge.first < edge.last;
  const bool hasEnds =
      areCoordinates(model.vertices[edge.start]) && areCoordinates(model.vertices[edge.end]);
  return hasRange && hasEnds && (!edge.curve || isValidCurve(model.curves[*edge.curve]));
}

/// Returns true if the face can be laid out in the plane: seams and degenerate edges have curves there.
bool isValidFace(const TrimmedModel& model, const TrimmedFace& face) {
  std::vector<std::uint32_t> projected;
  std::vector<std::uint32_t> all;
  for (const std::vector<Coedge>& loop : face.loops) {
    for (const Coedge& coedge : loop) {
      all.push_back(coedge.edge);
      if (coedge.inPlane) {
        if (!isValidCurve(*coedge.inPlane)) return false;
      } else if (!model.edges[coedge.edge].curve) {
        return false;
      } else {
        projected.push_back(coedge.edge);
      }
    }
  }
  return !all.empty() && std::ranges::all_of(projected, [&](std::uint32_t edge) {
    return std::ranges::count(all, edge) == 1;
  });
}

}  // namespace

std::optional<ReadModel> readModel(std::span<const double> numbers) {
  NumberReader reader(numbers);
  ReadModel read;
  TrimmedModel& model = read.model;
  do {
    appendModel(reader, model);
  } while (!reader.isAtEnd() && !reader.hasFailed());
  if (reader.hasFailed()) return std::nullopt;
  for (const FaceSurface& surface : model.surfaces) {
    read.isSurfaceValid.push_back(isValidSurface(surface) ? 1 : 0);
  }
  for (const TrimmedEdge& edge : model.edges) {
    read.isEdgeValid.push_back(isValidEdge(model, edge) ? 1 : 0);
  }
  const auto isSet = [](std::uint8_t flag) { return flag != 0; };
  read.isSound = !model.faces.empty() && std::ranges::all_of(read.isSurfaceValid, isSet) &&
                 std::ranges::all_of(read.isEdgeValid, isSet) &&
                 std::ranges::all_of(model.faces, [&](const TrimmedFace& face) {
                   return isValidFace(model, face);
                 });
  return read;
}

}  // namespace tetrafront
