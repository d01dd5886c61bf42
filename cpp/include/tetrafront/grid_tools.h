#pragma once

/// @file Background grids that need not be drawn: around a model, from a mesh, and sizes proposed
/// from a model's shape. All of them give plain data, to be edited or used at once.

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
  kSingleTetrahedron = 1,  ///< one tetrahedron, all that a uniform mesh needs (section 3)
};

/// A grid of `size` at every node over the box `low` to `high`, widened on each side by a
/// twentieth of its diagonal. Needs finite corners, low <= high, size > 0. A box that is a single
/// place gets a margin of `size`.
[[nodiscard]] BackgroundGrid coveringGrid(const Vec3& low, const Vec3& high, double size,
                                          CoverShape shape);

/// The same around the points, lines and patches of a model, curved ones as they bulge. Parts of
/// the model that cannot be evaluated are left out; an empty grid if nothing is left.
/// `size` 0: a twentieth of the model's diagonal. Cost as of previewModel().
[[nodiscard]] BackgroundGrid coveringGrid(const Model& model, double size, CoverShape shape);

/// coveringGrid() in slices.
class ModelCoverer {
 public:
  ModelCoverer(Model model, double size, CoverShape shape);
  ModelCoverer(ModelCoverer&&) noexcept;
  ModelCoverer& operator=(ModelCoverer&&) noexcept;
  ~ModelCoverer();

  /// Works on for about `budget` steps, to look at a patch being many; true when finished.
  bool advance(std::uint32_t budget);

  /// 0 to 1.
  [[nodiscard]] double fraction() const;

  /// Complete once advance() has returned true.
  [[nodiscard]] const BackgroundGrid& result() const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

/// A generated mesh as background grid (section 3). `sizes` holds one wanted size per node of the
/// mesh; empty: sizes with which the mesh asks for about as many elements as it has, from the
/// lengths of the edges at each node, averaged. Nodes without an element are left out. A mesh
/// whose front was not closed covers only what it fills. O(mesh).
[[nodiscard]] BackgroundGrid gridFromMesh(const VolumeMesh& mesh, std::span<const double> sizes);

/// gridFromMesh() in slices.
class MeshGridder {
 public:
  MeshGridder(VolumeMesh mesh, std::vector<double> sizes);
  MeshGridder(MeshGridder&&) noexcept;
  MeshGridder& operator=(MeshGridder&&) noexcept;
  ~MeshGridder();

  /// Works on for `budget` elements or nodes; true when finished.
  bool advance(std::uint32_t budget);

  /// 0 to 1.
  [[nodiscard]] double fraction() const;

  /// Complete once advance() has returned true.
  [[nodiscard]] const BackgroundGrid& result() const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

/// What proposeSizes() looks at. Each of the last two is left out where 0.
struct ProposalOptions {
  double uniform = 0.0;             ///< the largest size; 0: a twentieth of the model's diagonal
  double smallest = 0.0;            ///< no proposal below this; 0: a fiftieth of the largest
  double elementsPerCircle = 24.0;  ///< around a full turn of a curved line or patch
  double elementsPerGap = 3.0;      ///< between opposite patches, across the inside
  double growth = 0.3;              ///< of the proposed sources
};

struct SizeProposal {
  double size = 0.0;                ///< uniform, to be refined by the sources; 0: nothing to see
  std::vector<SizeSource> sources;  ///< smallest first; none where `size` is small enough
};

/// Sizes from the model's shape: a uniform one, and sources along lines and on patches that bend
/// or come near each other, as seen at the resolution of previewModel(). A proposal, not a
/// promise: finer detail than that is missed. Sources that smaller ones nearby make needless are
/// left out. Milliseconds for the models people draw.
[[nodiscard]] SizeProposal proposeSizes(const Model& model, const ProposalOptions& options);

/// proposeSizes() in slices.
class SizeProposer {
 public:
  SizeProposer(Model model, const ProposalOptions& options);
  SizeProposer(SizeProposer&&) noexcept;
  SizeProposer& operator=(SizeProposer&&) noexcept;
  ~SizeProposer();

  /// Works on for about `budget` steps, to look at a patch being many; true when finished. The tree of
  /// all sampled triangles is built, and the proposals are sorted, in one step each.
  bool advance(std::uint32_t budget);

  /// 0 to 1.
  [[nodiscard]] double fraction() const;

  /// Complete once advance() has returned true.
  [[nodiscard]] const SizeProposal& result() const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace tetrafront
