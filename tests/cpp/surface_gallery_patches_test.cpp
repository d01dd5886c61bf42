// Every patch of every bundled model, alone and with a uniform size: the triangles have the promised quality if the size
// is small compared with the patch and its lines form no sharp corner.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "model/resolved_model.h"
#include "support/gallery.h"
#include "surface/surface_mesher.h"

namespace tetrafront::testing {
namespace {

/// Limits that the lines of a patch set for its triangles.
struct Outline {
  double perimeter = 0.0;                                     ///< of the outer loop
  double shortest = std::numeric_limits<double>::infinity();  ///< line
  double sharpest = 180.0;                                    ///< corner, in degrees
};

Outline outlineOf(const Model& model, const Patch& patch) {
  const ResolvedModel resolved(model);
  Outline outline;
  for (const OrientedLine& line : patch.loops.front())
    outline.perimeter += resolved.curve(line).length();
  for (const Loop& loop : patch.loops) {
    for (std::size_t i = 0; i < loop.size(); ++i) {
      outline.shortest = std::min(outline.shortest, resolved.curve(loop[i]).length());
      // The corners around a hole are wide angles of the patch.
      if (&loop != &patch.loops.front()) continue;
      const Vec3 in = -resolved.curve(loop[i]).sample(1.0).derivative;
      const Vec3 out = resolved.curve(loop[(i + 1) % loop.size()]).sample(0.0).derivative;
      const double cosine = glm::dot(in, out) / (glm::length(in) * glm::length(out));
      outline.sharpest = std::min(
          outline.sharpest, std::acos(std::clamp(cosine, -1.0, 1.0)) * 180.0 / std::numbers::pi);
    }
  }
  return outline;
}

PatchSummary summaryOf(Model model, const Patch& patch, double size) {
  model.patches = {patch};
  const SizeField field = SizeField::uniform(size);
  SurfaceMesher mesher(model, field);
  MeshStatus status = MeshStatus::kRunning;
  while (status == MeshStatus::kRunning) status = mesher.advance(1000);
  EXPECT_EQ(status, MeshStatus::kDone);
  return mesher.patchSummaries().front();
}

TEST(SurfaceGalleryPatches, TrianglesHaveThePromisedQualityAtAUniformSize) {
  // A size is small if a square of the same perimeter is at least eight sizes wide, and the shortest line at least three
  // sizes long.
  constexpr double kAcross = 8.0;
  constexpr double kAlong = 3.0;
  constexpr double kAngle = 20.0;
  std::size_t patches = 0;
  std::size_t sharp = 0;
  for (const auto& [name, model, patchNames] : galleryModels()) {
    for (std::size_t i = 0; i < model.patches.size(); ++i) {
      SCOPED_TRACE(name + ": " + patchNames[i]);
      const Outline outline = outlineOf(model, model.patches[i]);
      ++patches;
      // The angle of a triangle in a corner is at most that of the corner.
      const bool isSharp = outline.sharpest < kAngle;
      sharp += isSharp ? 1 : 0;
      for (const double finer : {1.0, 2.0}) {
        // A finer mesh has four times as many triangles: every third patch gets one.
        if (finer > 1.0 && patches % 3 != 0) continue;
        const double size =
            std::min(0.25 * outline.perimeter / kAcross, outline.shortest / kAlong) / finer;
        const PatchSummary found = summaryOf(model, model.patches[i], size);
        EXPECT_GE(found.minAngle, isSharp ? 0.85 * outline.sharpest : kAngle);
        EXPECT_GE(found.meanRadiusRatio, 0.93);
        EXPECT_NEAR(found.meanEdge, 1.0, 0.1);
      }
    }
  }
  EXPECT_GE(patches, 250U);
  EXPECT_LE(sharp, 1U);
}

}  // namespace
}  // namespace tetrafront::testing
