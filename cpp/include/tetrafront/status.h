#pragma once

/// @file How a run ends and what it has to say. Bad input is a value here, never an exception.

#include <array>
#include <cstdint>
#include <vector>

#include "tetrafront/vec3.h"

namespace tetrafront {

enum class MeshStatus : std::uint8_t {
  kRunning = 0,       ///< call advance() again
  kDone = 1,          ///< the region is filled
  kStalled = 2,       ///< no face of the remaining front can be completed; the partial mesh is kept
  kCancelled = 3,     ///< stopped on request; the partial mesh is kept
  kInvalidInput = 4,  ///< see the diagnostics; what is meshed, if anything, is partial
};

/// The stages of a run in their order.
enum class Phase : std::uint8_t {
  kCheck = 0,     ///< the input is examined
  kSides = 1,     ///< lines are divided into sides (5.1)
  kSurface = 2,   ///< patches are triangulated (5.2) and stitched
  kVolume = 3,    ///< the front advances (section 2, F4-F9)
  kOptimize = 4,  ///< elements are made better; the boundary stays
  kVerify = 5,    ///< the result is checked and measured
};
inline constexpr std::size_t kPhaseCount = 6;

enum class EntityKind : std::uint8_t {
  kPoint = 0,
  kLine = 1,
  kPatch = 2,
  kBackgroundNode = 3,
  kBackgroundTetrahedron = 4,
  kTriangle = 5,     ///< of the given or generated surface
  kSurfaceNode = 6,  ///< of the given or generated surface
  kSource = 7,       ///< of size, in BackgroundGrid::sources
};

/// Something a diagnostic is about: a kind and a position in the array of that kind.
struct Entity {
  EntityKind kind = EntityKind::kPoint;
  std::uint32_t index = 0;
};

/// What is wrong. The sentence, the names and the remedy are composed by the caller, who knows
/// what the user called things; `values` holds the numbers the sentence needs, in the order given.
enum class DiagnosticCode : std::uint16_t {
  // Model
  kNotFinite = 0,         ///< entity: point, node or surface node with a NaN or infinity
  kIndexOutOfRange = 1,   ///< entity refers to something that does not exist, or is cut off
                          ///< itself; values: the index of what does not exist
  kWrongPointCount = 2,   ///< line; values: points given
  kCoincidentPoints = 3,  ///< two points of one line at the same place
  kZeroLengthLine = 4,    ///< line
  kWrongLineCount = 5,    ///< patch; values: lines given in its outer loop, lines wanted
  kWrongLineType = 6,     ///< patch and line: the patch type does not accept this line type
  kLoopNotClosed = 7,     ///< patch, line, point: the chain breaks after the line
  kLoopsIntersect = 8,    ///< patch, line(s): loop crosses or touches itself or another loop
  kNotPlanar = 9,    ///< planar patch, line(s), point(s) moved; values: distance from the plane
  kEmptyModel = 12,  ///< no patch, or no triangle
  kDegeneratePatch = 13,       ///< patch whose surface has no area or folds over itself
  kHoleOutside = 14,           ///< patch, line: a hole outside the outer loop or in a hole
  kOptionOutOfRange = 15,      ///< values: which (0 size, 1 growth, 2 gradation), what was given
  kLineSelfIntersection = 16,  ///< line, also one that runs back over itself; place
  kPatchesIntersect = 17,      ///< two patches that overlap or cross away from common lines; place
  kHoleOffPatch = 18,          ///< curved patch, line of a hole that is not on it; values: distance
  kDuplicateLines = 19,        ///< two lines of the same course; a warning unless patches use both
  // Background grid
  kEmptyBackgroundGrid = 20,
  kSizeOutOfRange = 21,        ///< node; values: size
  kStretchingOutOfRange = 22,  ///< node; values: stretching
  kDegenerateBackgroundTetrahedron = 23,
  kOutsideBackgroundGrid = 24,  ///< place (and line or patch): the grid does not cover the domain
  kTooManyElements = 25,        ///< values: estimated tetrahedra, limit
  kSourceOutOfRange = 26,       ///< source; values: size, distance, growth
  kDuplicatePoints = 27,        ///< two points at one place; a warning unless patches use both
  kSizeTooLarge = 28,           ///< warning; values: the size, smallest in a model, and the extent
  // Closed boundary
  kOpenEdge = 40,       ///< line (and its patch) or triangle with one side missing; values: number
                        ///< of such edges
  kDanglingSheet = 41,  ///< triangle (and its patch) with one space on both sides
  kInconsistentOrientation = 42,  ///< triangles that cannot be oriented consistently
  kSelfIntersection = 43,         ///< two triangles (and their patches) meet where they should not
  kDuplicateTriangle = 44,        ///< two triangles with the same nodes
  kDegenerateTriangle = 45,       ///< triangle with repeated or collinear nodes
  kZeroVolume = 46,               ///< shell that encloses nothing
  kReorientedPatch = 47,  ///< information: patch, or whole part of a given surface, drawn inside
                          ///< out and turned round; values of the latter: triangles turned, all
  kCoincidentNodes = 48,  ///< two nodes at one place that are not joined
  kNestedRegions = 49,    ///< information; values: number of regions, of cavities
  /// Triangle of a given surface that faces inward while others of its component face outward;
  /// values: 1 if it would be an interface with EnclosedBodies::kRegions, else 0; number of such
  /// triangles.
  kFlippedTriangle = 50,
  kCoarseSurface = 51,  ///< warning; triangle of a given surface with the longest edges in wanted
                        ///< lengths, place; values: number of triangles with edges more than twice
                        ///< as long as wanted, wanted lengths of the longest
  // Volume
  kStalled = 60,             ///< values: faces left in the front
  kVerificationFailed = 61,  ///< values: failing elements; our own mistake, never the user's
};

enum class Severity : std::uint8_t { kInformation = 0, kWarning = 1, kError = 2 };

struct Diagnostic {
  DiagnosticCode code = DiagnosticCode::kNotFinite;
  Severity severity = Severity::kError;
  std::vector<Entity> entities;  ///< the most telling first
  bool hasPlace = false;
  Vec3 place{0.0};  ///< where, in model coordinates, when hasPlace
  std::vector<double> values;
};

/// Element quality of a finished or partial mesh.
struct QualitySummary {
  double minDihedral = 0.0;     ///< degrees
  double maxDihedral = 0.0;     ///< degrees
  double minRadiusRatio = 0.0;  ///< 3 x inradius / circumradius, 1 for the regular tetrahedron
  double meanRadiusRatio = 0.0;
  double volume = 0.0;  ///< sum over the tetrahedra
};

/// The triangulation of one patch of a drawn model.
struct PatchSummary {
  std::uint32_t patch = 0;  ///< position in Model::patches
  std::uint32_t triangles = 0;
  double minAngle = 0.0;         ///< degrees, in space
  double meanRadiusRatio = 0.0;  ///< 2 x inradius / circumradius, 1 for the equilateral triangle
  double meanEdge = 0.0;  ///< edge length over the wanted one, in the metric; 1 is as asked for
  /// Largest distance, in model units, between a triangle and the true patch, sampled at the
  /// triangles' centroids and the middles of their edges.
  double chordDeviation = 0.0;
};

/// Live figures, cheap enough to be read after every slice.
struct Progress {
  Phase phase = Phase::kCheck;
  double fraction = 0.0;  ///< of the whole run, estimated, never decreasing
  std::uint32_t points = 0;
  std::uint32_t triangles = 0;
  std::uint32_t tetrahedra = 0;
  std::uint32_t frontFaces = 0;
  /// As many as the sizes ask for, estimated before the front starts; 0 until then.
  std::uint32_t expectedTetrahedra = 0;
  /// How far the exact fill is with what the front has left open, 0 to 1, estimated; 0 while it is not at work.
  double exactFill = 0.0;
};

/// How the front was brought to an end, for those who want to know.
struct RecoverySummary {
  std::uint32_t relaxed = 0;   ///< elements accepted by a relaxed rule class (L1)
  std::uint32_t starred = 0;   ///< pockets filled from one interior point (L3)
  std::uint32_t reopened = 0;  ///< pockets filled after elements around them were removed (L2)
  std::uint32_t filled = 0;    ///< pockets given to the exact fill (L6), all else having failed
  std::uint32_t steinerPoints = 0;  ///< interior points made by the exact fill
};

/// Why candidates were refused while the front advanced, and how hard the crossing filters worked.
struct FrontCounters {
  std::uint64_t pops = 0;           ///< faces taken from the heap
  std::uint64_t gatheredFaces = 0;  ///< faces passed by the box filter (a)
  std::uint64_t candidatesTried = 0;
  std::uint64_t facesTested = 0;    ///< face-element pairs seen by the local coordinate filter (b)
  std::uint64_t facesAnalysed = 0;  ///< pairs left for the side-face analysis (c)
  std::uint64_t exactPredicates = 0;  ///< signs that needed exact arithmetic
};

}  // namespace tetrafront
