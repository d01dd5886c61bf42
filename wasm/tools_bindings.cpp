/// @file Binds the tools, which work in slices and have one result each, for the module "tools".

#include "bindings.h"
#include "tetrafront/covering_grid.h"
#include "tetrafront/curvature_samples.h"
#include "tetrafront/grid_from_mesh.h"
#include "tetrafront/mesh_adaptation.h"
#include "tetrafront/mesh_improvement.h"
#include "tetrafront/mesh_inspection.h"
#include "tetrafront/node_placement.h"
#include "tetrafront/region_location.h"
#include "tetrafront/remesh.h"
#include "tetrafront/second_order.h"
#include "tetrafront/size_proposals.h"
#include "tetrafront/size_samples.h"
#include "tetrafront/solution.h"
#include "tetrafront/surface_tools.h"
#include "tetrafront/wall_layers.h"

namespace tetrafront::border {

/// Structs in arguments cross as columns.
template <>
inline constexpr bool kInColumns<PatchLayers> = true;

}  // namespace tetrafront::border

EMSCRIPTEN_BINDINGS(tools) {
  using namespace emscripten;
  using namespace tetrafront;
  using namespace tetrafront::border;

  registerTypes<Doubles, Indices, bool, double, Model, VolumeMesh, BackgroundGrid, CoverShape,
                MeshOptions, InspectionOptions, RepairOptions, RemeshOptions, ProposalOptions,
                BodySurfaces, GivenRegions, ModelTriangles, SolutionFields,
                SolutionMetricOptions>();
  registerTypes<SurfaceInspection, MeshInspection, SurfaceRepair, SurfaceRefinement, SurfaceRemesh,
                PatchSplit, SizeProposal, RegionLocation, SurfaceSizeProposal, SizeSamples,
                CurvatureSamples, NodePlacement, SecondOrderMesh, SolutionMetric,
                TransferredSolution, FrontSizes>();

  registerTool<SurfaceInspector, Doubles, Indices, InspectionOptions, Indices>("Inspection",
                                                                               "inspectSurface");
  registerTool<RegionLocator, Doubles, Indices, Doubles>("Location", "locateRegions");
  registerTool<SurfaceSizeProposer, Doubles, Indices, Indices, RemeshOptions, Indices>(
      "SurfaceProposal", "proposeSurfaceSizes");
  registerTool<MeshInspector, Doubles, Indices, Indices>("VolumeInspection", "inspectMesh");
  registerTool<SurfaceRepairer, Doubles, Indices, RepairOptions, Indices>("Repair",
                                                                          "repairSurface");
  registerTool<SurfaceRefiner, Doubles, Indices, BackgroundGrid, MeshOptions, double, GivenRegions>(
      "Refinement", "refineSurface");
  registerTool<PatchSplitter, Doubles, Indices, Indices, double>("PatchSplitting", "splitPatches");
  registerTool<SurfaceRemesher, Doubles, Indices, Indices, BackgroundGrid, RemeshOptions,
               GivenRegions, Doubles>("Remesh", "remeshSurface");
  registerTool<NodePlacer, Doubles, Indices, Indices, Doubles, ModelTriangles, double>(
      "Placement", "placeNodes");
  registerTool<SecondOrderBuilder, Doubles, Indices, Indices, Indices, Doubles>("SecondOrder",
                                                                                "curveEdges");
  registerTypes<ImproveOptions, MeshImprovement>();
  registerTool<MeshImprover, Doubles, Indices, Indices, Indices, ImproveOptions>("Improvement",
                                                                                 "improveMesh");
  registerTypes<AdaptInput, MetricMesh, AdaptOptions, MeshAdaptation>();
  registerTool<MeshAdapter, AdaptInput, MetricMesh, AdaptOptions>("Adaptation", "adaptMesh");
  registerTypes<std::vector<PatchLayers>, LayerOptions, LayeredMesh>();
  registerTool<LayerMaker, AdaptInput, MetricMesh, AdaptOptions, std::vector<PatchLayers>,
               LayerOptions>("Layers", "addLayers");
  registerTool<CoveringGridBuilder, Model, double, CoverShape>("Cover", "cover");
  registerTool<SizeProposer, Model, ProposalOptions>("Proposal", "propose");
  registerTool<SizeSampler, Model, BodySurfaces, BackgroundGrid, MeshOptions, Doubles>(
      "SizeSampling", "sampleSizes");
  registerTool<CurvatureSampler, Model, double>("CurvatureSampling", "sampleCurvature");
  registerTool<MeshGridBuilder, VolumeMesh, Doubles>("BackgroundFromMesh", "backgroundFromMesh");
  registerTool<SolutionSizer, VolumeMesh, SolutionFields, SolutionMetricOptions>(
      "SolutionSizing", "sizeFromSolution");
  registerTool<FrontSizer, Doubles>("FrontSizing", "frontSizesOf");
  registerTool<SolutionTransferrer, VolumeMesh, VolumeMesh, SolutionFields, bool>(
      "SolutionTransfer", "transferSolution");
  function("memoryBytes", &memoryBytes);
}
