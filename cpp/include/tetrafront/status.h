#pragma once

/// @file Status, progress, diagnostics and summaries of a run. Invalid input is reported as a value, never as an
/// exception.

#include <array>
#include <cstdint>
#include <vector>

#include "tetrafront/vec3.h"

namespace tetrafront {

enum class MeshStatus : std::uint8_t {
  kRunning = 0,       ///< work remains: call advance() again
  kDone = 1,          ///< the mesh is complete
  kStalled = 2,       ///< the front could not be closed; the partial mesh is kept
  kCancelled = 3,     ///< cancelled by the caller; the partial mesh is kept
  kInvalidInput = 4,  ///< see the diagnostics; the mesh is partial or empty
};

/// Stages of a run, in their order.
enum class Phase : std::uint8_t {
  kCheck = 0,     ///< the input is checked
  kSides = 1,     ///< lines are divided into sides (5.1)
  kSurface = 2,   ///< patches are triangulated (5.2), and the boundary is checked
  kVolume = 3,    ///< the front advances (section 2, F4-F9)
  kOptimize = 4,  ///< elements are improved; the boundary stays
  kVerify = 5,    ///< the mesh is measured and verified
};
inline constexpr std::size_t kPhaseCount = 6;

/// Kind of what a diagnostic is about.
enum class EntityKind : std::uint8_t {
  kPoint = 0,
  kLine = 1,
  kPatch = 2,
  kBackgroundNode = 3,
  kBackgroundTetrahedron = 4,
  kTriangle = 5,     ///< of the given or generated surface
  kSurfaceNode = 6,  ///< of the given or generated surface
  kSource = 7,       ///< in BackgroundGrid::sources
  kNode = 8,         ///< of the volume mesh
  kTetrahedron = 9,  ///< of the volume mesh
};

/// Subject of a diagnostic: a kind, and an index into the array of that kind.
struct Entity {
  EntityKind kind = EntityKind::kPoint;
  std::uint32_t index = 0;
};

/// Kinds of problems. The comments list the entities that a diagnostic holds, in this order; valuesOf() in
/// diagnostic_values.h lists its values. The caller composes the sentence and the remedy, because it knows the names of
/// the entities.
enum class DiagnosticCode : std::uint16_t {
  // Model
  kNotFinite = 0,         ///< point, node or surface node with a NaN or infinity
  kIndexOutOfRange = 1,   ///< entity that has an invalid reference or is truncated
  kWrongPointCount = 2,   ///< line
  kCoincidentPoints = 3,  ///< two points of one line at the same position
  kZeroLengthLine = 4,    ///< line
  kWrongLineCount = 5,    ///< patch
  kWrongLineType = 6,     ///< patch, line: the patch type does not accept the line type
  kLoopNotClosed = 7,     ///< patch, line, point: the loop breaks after the line
  kLoopsIntersect = 8,    ///< patch, line(s): a loop intersects itself or another loop
  kNotPlanar = 9,         ///< planar patch, line(s), point(s) moved
  kCollinearPoints = 10,  ///< arc or circle, whose points lie on one straight line
  kWrongLoopCount = 11,   ///< patch: a tube that does not have two loops
  kEmptyModel = 12,       ///< no patch, or no triangle
  kDegeneratePatch = 13,  ///< patch whose surface has no area or folds over itself
  kHoleOutside = 14,      ///< patch, line: a hole outside the outer loop or inside another hole
  kOptionOutOfRange = 15,
  kLineSelfIntersection = 16,  ///< line that crosses itself or runs back over itself; position
  kPatchesIntersect = 17,  ///< two patches that overlap or cross away from common lines; position
  kHoleOffPatch = 18,      ///< curved patch, line of a hole that is not on it
  kDuplicateLines = 19,    ///< two lines along the same curve; a warning unless patches use both
  // Background grid
  kEmptyBackgroundGrid = 20,
  kSizeOutOfRange = 21,        ///< node
  kStretchingOutOfRange = 22,  ///< node
  kDegenerateBackgroundTetrahedron = 23,
  kOutsideBackgroundGrid = 24,  ///< position (and line or patch) that the grid does not cover
  /// The line, patch, source or background node that requires the most, or a position, or nothing. In a refinement or
  /// remeshing, the triangle that requires the most.
  kTooManyElements = 25,
  kSourceOutOfRange = 26,  ///< source
  kDuplicatePoints = 27,   ///< two points at one position; a warning unless patches use both
  kSizeTooLarge = 28,      ///< warning: no size of a model is below its extent
  kOpenCircle = 29,        ///< circle whose last point is not its first
  /// Loft, line: a section that does not run from a point of the fourth line to a point of the second, beyond the section
  /// before it.
  kMisplacedSection = 30,
  /// Background node: invalid second stretching, or directions that are not orthogonal.
  kSecondStretchingOutOfRange = 31,
  // Closed boundary
  kOpenEdge = 40,       ///< line (and its patch) or triangle with one triangle only at an edge
  kDanglingSheet = 41,  ///< triangle (and its patch) with the same region on both sides
  kInconsistentOrientation = 42,  ///< triangles that cannot be oriented consistently
  kSelfIntersection = 43,         ///< two triangles (and their patches) that intersect
  kDuplicateTriangle = 44,        ///< two triangles with the same nodes
  kDegenerateTriangle = 45,       ///< triangle with repeated or collinear nodes
  kZeroVolume = 46,               ///< shell that encloses no volume
  /// Information: patch, or component of a given surface, that faced inward and was flipped.
  kReorientedPatch = 47,
  kCoincidentNodes = 48,  ///< two nodes at one position that are not welded
  kNestedRegions = 49,    ///< information
  kFlippedTriangle =
      50,  ///< triangle of a given surface that faces inward in a component that faces outward
  /// Warning: triangle of a given surface whose edges are longest relative to the target length, position.
  kCoarseSurface = 51,
  /// Triangle of a given surface whose given regions contradict those of other triangles, or that has none.
  kInconsistentRegions = 52,
  /// Warning: triangle of a given surface that an exact repair could not resolve, position. Nothing was cut or removed.
  kUnresolvedSurface = 53,
  /// Information: triangle (or patch) at the first edge or node where the surface touches itself, position.
  kSurfaceContact = 54,
  // Volume
  kStalled = 60,
  /// One node, tetrahedron or triangle per kind of defect. A mistake of the engine, not of the input.
  kVerificationFailed = 61,
  /// Warning: tetrahedra that are larger than the permitted volume; the largest one, position.
  kLargeTetrahedra = 62,
  // Given mesh of tetrahedra
  kDegenerateTetrahedron = 70,  ///< tetrahedron whose volume is zero, exactly; position
  kNonManifoldFace = 71,        ///< the tetrahedra that share one face, more than two; position
  kOverlappingTetrahedra = 72,  ///< two tetrahedra that overlap or touch wrongly; position
};

/// Options whose range is checked.
enum class CheckedOption : std::uint8_t {
  kSize = 0,
  kGrowth = 1,
  kGradation = 2,
  // Of a remeshing
  kMinSize = 3,
  kMaxSize = 4,
  kTolerance = 5,
  kFeatureAngle = 6,
  kAnglePerEdge = 7,
  kLayers = 8,
  kDropDetails = 9,
  kMaxVolume = 10,
  kSizeFactor = 11,  ///< of a remeshing
};

enum class Severity : std::uint8_t { kInformation = 0, kWarning = 1, kError = 2 };

struct Diagnostic {
  DiagnosticCode code = DiagnosticCode::kNotFinite;
  Severity severity = Severity::kError;
  std::vector<Entity> entities;  ///< the most important first
  bool hasPosition = false;
  Vec3 position{0.0};          ///< in model coordinates, if hasPosition
  std::vector<double> values;  ///< as in valuesOf(code)

  /// Returns the diagnostic with other entities. This and the functions below complete one where it is made:
  ///     diagnose<DiagnosticCode::kStalled>(faces).about(entities).at(position)
  [[nodiscard]] Diagnostic about(std::vector<Entity> named) && {
    entities = std::move(named);
    return std::move(*this);
  }
  /// Returns the diagnostic with a position in model coordinates.
  [[nodiscard]] Diagnostic at(const Vec3& where) && {
    hasPosition = true;
    position = where;
    return std::move(*this);
  }
  /// Returns the diagnostic with another severity.
  [[nodiscard]] Diagnostic withSeverity(Severity chosen) && {
    severity = chosen;
    return std::move(*this);
  }
};

/// Default number of diagnostics listed per code. A badly damaged surface can have millions.
inline constexpr std::uint32_t kDefaultMaxDiagnostics = 1000;

/// Element quality of a complete or partial mesh, measured in space.
struct QualitySummary {
  double minDihedral = 0.0;     ///< degrees
  double maxDihedral = 0.0;     ///< degrees
  double minRadiusRatio = 0.0;  ///< 3 x inradius / circumradius, 1 for the regular tetrahedron
  double meanRadiusRatio = 0.0;
  double volume = 0.0;  ///< sum over the tetrahedra
};

/// Triangulation of one patch of a drawn model or a body.
struct PatchSummary {
  std::uint32_t patch = 0;  ///< index, as in SurfaceMesh::trianglePatch
  std::uint32_t triangles = 0;
  double minAngle = 0.0;         ///< degrees, in space
  double meanRadiusRatio = 0.0;  ///< 2 x inradius / circumradius, 1 for the equilateral triangle
  double meanEdge = 0.0;  ///< mean of length / target length, in the metric of the size field
  /// Largest distance, in model units, between a triangle and the exact patch, sampled at the centroids of the
  /// triangles and the midpoints of their edges; 0 for a body, whose triangles are given.
  double chordDeviation = 0.0;
};

/// State of a run, cheap enough to be read after every slice.
struct Progress {
  Phase phase = Phase::kCheck;
  double fraction = 0.0;  ///< estimated progress of the run, 0 to 1; never decreases
  std::uint32_t nodes = 0;
  std::uint32_t triangles = 0;
  std::uint32_t tetrahedra = 0;
  std::uint32_t frontFaces = 0;
  /// Number of tetrahedra that the sizes ask for, estimated before the front starts; 0 until then.
  std::uint32_t expectedTetrahedra = 0;
  /// Estimated progress of the exact fill, 0 to 1; 0 while it is not running.
  double exactFillFraction = 0.0;
};

/// Counts of the steps that closed a stalled front.
struct RecoverySummary {
  std::uint32_t relaxed = 0;        ///< elements accepted by a relaxed rule class
  std::uint32_t starred = 0;        ///< pockets filled from one interior point
  std::uint32_t remeshed = 0;       ///< pockets filled by local remeshing
  std::uint32_t filled = 0;         ///< pockets filled by the exact fill, which comes last
  std::uint32_t steinerPoints = 0;  ///< interior points added by the exact fill
};

/// Counts of the work of the front and its crossing test.
struct FrontCounters {
  std::uint64_t pops = 0;           ///< faces taken from the heap
  std::uint64_t gatheredFaces = 0;  ///< faces that passed the box filter (a)
  std::uint64_t candidatesTried = 0;
  std::uint64_t facesTested = 0;  ///< face-element pairs tested by the local coordinate filter (b)
  std::uint64_t facesAnalysed = 0;    ///< pairs left for the analysis of side faces (c)
  std::uint64_t exactPredicates = 0;  ///< signs that needed exact arithmetic
};

}  // namespace tetrafront
