#pragma once

/// @file Generated background grids: around a model or from a mesh; and sizes proposed from the shape of a model.
/// The results are plain data that can be edited or used directly.

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "tetrafront/background_grid.h"
#include "tetrafront/mesh.h"
#include "tetrafront/model.h"

namespace tetrafront {

enum class CoverShape : std::uint8_t {
  kBox = 0,                ///< an axis-parallel box in five tetrahedra, 8 nodes
  kSingleTetrahedron = 1,  ///< one tetrahedron, enough for a uniform mesh (section 3)
};

/// Returns a grid with `size` at every node that covers the box from `low` to `high`, widened on each side by a
/// twentieth of its diagonal, or by `size` if the box is a single position. The corners must be finite,
/// low <= high and size > 0.
[[nodiscard]] BackgroundGrid coveringGrid(const Vec3& low, const Vec3& high, double size,
                                          CoverShape shape);

/// Returns such a grid around the points, lines and patches of a model, including the bulge of curved ones. Leaves
/// out parts of the model that cannot be evaluated; the grid is empty if nothing else is there. `size` 0 stands
/// for a twentieth of the model's diagonal. Costs as much as previewModel().
[[nodiscard]] BackgroundGrid coveringGrid(const Model& model, double size, CoverShape shape);

/// Does the work of coveringGrid() in slices.
class CoveringGridBuilder {
 public:
  CoveringGridBuilder(Model model, double size, CoverShape shape);
  CoveringGridBuilder(CoveringGridBuilder&&) noexcept;
  CoveringGridBuilder& operator=(CoveringGridBuilder&&) noexcept;
  ~CoveringGridBuilder();

  /// Does about `budget` units of work, of which a patch takes many; true when finished.
  bool advance(std::uint32_t budget);

  /// Estimated progress, 0 to 1.
  [[nodiscard]] double fraction() const;

  /// Complete once advance() has returned true.
  [[nodiscard]] const BackgroundGrid& result() const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

/// Returns a generated mesh as a background grid (section 3). `sizes` holds one target size per node of the mesh. If
/// it is empty, the sizes follow from the mean edge length at each node, so that the grid asks for about as many
/// elements as the mesh has. Leaves out nodes without an element. An incomplete mesh covers only what it fills.
/// O(n) for n elements.
[[nodiscard]] BackgroundGrid gridFromMesh(const VolumeMesh& mesh, std::span<const double> sizes);

/// Does the work of gridFromMesh() in slices.
class MeshGridBuilder {
 public:
  MeshGridBuilder(VolumeMesh mesh, std::vector<double> sizes);
  MeshGridBuilder(MeshGridBuilder&&) noexcept;
  MeshGridBuilder& operator=(MeshGridBuilder&&) noexcept;
  ~MeshGridBuilder();

  /// Visits about `budget` elements or nodes; true when finished.
  bool advance(std::uint32_t budget);

  /// Estimated progress, 0 to 1.
  [[nodiscard]] double fraction() const;

  /// Complete once advance() has returned true.
  [[nodiscard]] const BackgroundGrid& result() const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

/// Options of proposeSizes(). 0 turns off `elementsPerCircle` or `elementsPerGap`.
struct ProposalOptions {
  double uniform = 0.0;             ///< largest size; 0: a twentieth of the model's diagonal
  double smallest = 0.0;            ///< smallest size proposed; 0: a fiftieth of the largest
  double elementsPerCircle = 24.0;  ///< elements around a full circle of a curved line or patch
  double elementsPerGap = 3.0;      ///< elements across the inside, between opposite patches
  double growth = 0.3;              ///< growth of the proposed sources
};

struct SizeProposal {
  double size = 0.0;  ///< uniform size, which the sources refine; 0: nothing could be sampled
  std::vector<SizeSource> sources;  ///< smallest first; none if `size` is small enough everywhere
};

/// Proposes a uniform size, and sources on lines and patches that are curved or close to each other. Works on the
/// samples of previewModel(), so it misses finer detail. Omits a source if smaller sources nearby already ask for
/// its size. Takes milliseconds for typical models.
[[nodiscard]] SizeProposal proposeSizes(const Model& model, const ProposalOptions& options);

/// Does the work of proposeSizes() in slices.
class SizeProposer {
 public:
  SizeProposer(Model model, const ProposalOptions& options);
  SizeProposer(SizeProposer&&) noexcept;
  SizeProposer& operator=(SizeProposer&&) noexcept;
  ~SizeProposer();

  /// Does about `budget` units of work, of which a patch takes many; true when finished. Building the tree over all
  /// sampled triangles and sorting the proposals are not divided.
  bool advance(std::uint32_t budget);

  /// Estimated progress, 0 to 1.
  [[nodiscard]] double fraction() const;

  /// Complete once advance() has returned true.
  [[nodiscard]] const SizeProposal& result() const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace tetrafront
