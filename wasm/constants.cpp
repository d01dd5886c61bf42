/// @file Prints the TypeScript module src/generated/constants.ts: the enums, limits, defaults and types that the package
/// shares with the engine. The build runs this program, so that an enumerator or a constant is written once, in the
/// engine's headers.

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "failure.h"
#include "geom/coordinates.h"
#include "js_types.h"
#include "reflection.h"
#include "surface/rules.h"
#include "tetrafront/covering_grid.h"
#include "tetrafront/curvature_samples.h"
#include "tetrafront/diagnostic_values.h"
#include "tetrafront/mesh_adaptation.h"
#include "tetrafront/mesh_improvement.h"
#include "tetrafront/options.h"
#include "tetrafront/plane_fill.h"
#include "tetrafront/quality_statistics.h"
#include "tetrafront/remesh.h"
#include "tetrafront/size_proposals.h"
#include "tetrafront/solution.h"
#include "tetrafront/wall_layers.h"
#include "tetrafront/status.h"
#include "tetrafront/surface_tools.h"
#include "volume/rules.h"

namespace tetrafront::border {
namespace {

/// Enumerators have values below this: all that fit into 8 bits.
constexpr std::size_t kMaxEnumerators = 256;

/// The names of the enumerators by value; empty without an enumerator.
template <class Enum>
constexpr std::array<std::string_view, kMaxEnumerators> kEnumerators =
    []<std::size_t... Value>(std::index_sequence<Value...>) {
      return std::array{enumeratorName<static_cast<Enum>(Value)>()...};
    }(std::make_index_sequence<kMaxEnumerators>{});

/// True if the values count from 0 without a gap.
template <class Enum>
constexpr bool kCountsFromZero =
    std::is_partitioned(kEnumerators<Enum>.begin(), kEnumerators<Enum>.end(),
                        [](std::string_view name) { return !name.empty(); });

/// Returns `kSmallestFirst` as `"smallest-first"`.
std::string quoted(std::string_view name) {
  std::string text = "\"";
  for (const char letter : name.substr(1)) {
    const bool isUpper = letter >= 'A' && letter <= 'Z';
    if (isUpper && text.size() > 1) text += '-';
    text += isUpper ? static_cast<char>(letter - 'A' + 'a') : letter;
  }
  return text + '"';
}

/// Returns the quoted names of all enumerators, with `separator` between them.
template <class Enum>
std::string listOf(std::string_view separator) {
  std::string list;
  for (const std::string_view name : kEnumerators<Enum>) {
    if (name.empty()) continue;
    if (!list.empty()) list += separator;
    list += quoted(name);
  }
  return list;
}

/// Returns the shortest text that reads back as the same number.
std::string textOf(double number) {
  std::array<char, 32> text{};
  const char* end = std::to_chars(text.begin(), text.end(), number).ptr;
  return {static_cast<const char*>(text.data()), end};
}

void print(const std::string& line) { std::puts(line.c_str()); }

/// Prints the union of the names of an enum.
template <class Enum>
void printUnion(std::string_view type, std::string_view meaning) {
  print("/** " + std::string(meaning) + " */");
  print("export type " + std::string(type) + " = " + listOf<Enum>(" | ") + ";");
}

/// Prints an enum whose values count from 0: its names in the order of the values.
template <class Enum>
void printEnum(std::string_view type, std::string_view constant, std::string_view meaning) {
  static_assert(kCountsFromZero<Enum>);
  printUnion<Enum>(type, meaning);
  print("/** All values of `" + std::string(type) +
        "`, in the order of their numbers in the engine. */");
  print("export const " + std::string(constant) + " = [" + listOf<Enum>(", ") + "] as const;");
}

/// Prints an enum with gaps between its values: its names by value.
template <class Enum>
void printTable(std::string_view type, std::string_view constant, std::string_view meaning) {
  printUnion<Enum>(type, meaning);
  print("/** Names of the codes by the numbers of the engine. */");
  print("export const " + std::string(constant) + " = {");
  for (std::size_t value = 0; value < kMaxEnumerators; ++value) {
    const std::string_view name = kEnumerators<Enum>[value];
    if (!name.empty()) print("  " + std::to_string(value) + ": " + quoted(name) + ",");
  }
  print("} as const;");
}

void printNumber(std::string_view constant, double value, std::string_view meaning) {
  print("/** " + std::string(meaning) + " */");
  print("export const " + std::string(constant) + " = " + textOf(value) + ";");
}

/// Prints the default values of a struct; enumerators by their names.
template <Record T>
void printDefaults(std::string_view constant, std::string_view meaning) {
  print("/** " + std::string(meaning) + " */");
  print("export const " + std::string(constant) + " = {");
  const T defaults{};
  const auto fields = fieldsOf(defaults);
  forEachField<T>([&](auto index) {
    constexpr std::size_t kIndex = decltype(index)::value;
    using Field = FieldType<T, kIndex>;
    const Field value = std::get<kIndex>(fields);
    std::string text;
    if constexpr (std::is_same_v<Field, bool>) {
      text = value ? "true" : "false";
    } else if constexpr (std::is_enum_v<Field>) {
      text = quoted(kEnumerators<Field>[static_cast<std::size_t>(value)]);
    } else {
      text = textOf(static_cast<double>(value));
    }
    print("  " + std::string(fieldName<T, kIndex>()) + ": " + text + ",");
  });
  print("} as const;");
}

/// Prints the type of T as it crosses the border.
template <class T>
void printType(std::string_view type, std::string_view meaning) {
  print("/** " + std::string(meaning) + " */");
  print("export type " + std::string(type) + " = " + kTypeScriptType<T>.data() + ";");
}

/// Returns the type of a named value in TypeScript.
std::string_view typeOf(ValueType type) {
  switch (type) {
    case ValueType::kNumber:
      return "number";
    case ValueType::kFlag:
      return "boolean";
    case ValueType::kOption:
      return "CheckedOption";
  }
}

/// Calls `use` with the quoted name of each code and its values.
template <class Use>
void forEachCode(const Use& use) {
  for (std::size_t code = 0; code < kMaxEnumerators; ++code) {
    const std::string_view name = kEnumerators<DiagnosticCode>[code];
    if (!name.empty()) use(quoted(name), valuesOf(static_cast<DiagnosticCode>(code)));
  }
}

/// Prints the values of the diagnostics: their types, and their names in the order of the engine.
void printDiagnosticValues() {
  print(
      "/** Data of the diagnostics of the engine, for each code that has any. Lengths are in model "
      "units. */");
  print("export interface EngineNumbers {");
  forEachCode([](const std::string& code, const DiagnosticValues& values) {
    if (values.size() == 0) return;
    print("  readonly " + code + ": {");
    for (const DiagnosticValue& value : values) {
      print("    /** " + std::string(value.meaning) + " */");
      print("    readonly " + std::string(value.name) + (value.isOptional ? "?: " : ": ") +
            std::string(typeOf(value.type)) + ";");
    }
    print("  };");
  });
  print("}");
  printUnion<ValueType>(
      "ValueType", "How a value of a diagnostic is read: a flag is 1 or 0, an option an index.");
  print("/** Value of a diagnostic. */");
  print(
      "export interface EngineValue { readonly name: string; readonly type: ValueType; readonly "
      "isOptional: boolean; }");
  print(
      "/** Values of the diagnostics of each code, in the order of the engine. The optional ones "
      "come last. */");
  print(
      "export const ENGINE_VALUES: { readonly [Code in EngineCode]: readonly EngineValue[] } = {");
  forEachCode([](const std::string& code, const DiagnosticValues& values) {
    std::string list;
    for (const DiagnosticValue& value : values) {
      if (!list.empty()) list += ", ";
      list += "{ name: \"" + std::string(value.name) +
              "\", type: " + quoted(kEnumerators<ValueType>[static_cast<std::size_t>(value.type)]) +
              ", isOptional: " + (value.isOptional ? "true" : "false") + " }";
    }
    print("  " + code + ": [" + list + "],");
  });
  print("};");
}

void printEnums() {
  printEnum<MeshStatus>("EngineStatus", "ENGINE_STATUSES", "Status of a run.");
  printEnum<Phase>("Phase", "PHASES", "Stages of a run, in order.");
  printEnum<Severity>("Severity", "SEVERITIES", "Only errors prevent meshing.");
  printEnum<EntityKind>("EntityKind", "ENTITY_KINDS",
                        "Kind of an entity that a diagnostic refers to.");
  printEnum<RepairKind>("RepairKind", "REPAIR_KINDS", "Kinds of changes of a repair.");
  printEnum<PoorReason>("PoorReason", "POOR_REASONS", "Why an element has a small dihedral angle.");
  printEnum<LineType>("LineType", "LINE_TYPES", "Curve type of a line.");
  printEnum<PatchType>("PatchType", "PATCH_TYPES", "Surface type of a patch.");
  printEnum<SourceType>("SourceType", "SOURCE_TYPES", "Shape of a source of size.");
  printEnum<CoverShape>("CoverShape", "COVER_SHAPES",
                        "Shape of a covering grid: five tetrahedra that fill a box, or one.");
  printEnum<ErrorNorm>("ErrorNorm", "ERROR_NORMS", "Norm of the interpolation error of a field.");
  printEnum<InnerShells>("InnerShells", "INNER_SHELLS",
                         "What a closed shell inside a region bounds.");
  printEnum<FrontOrder>("FrontOrder", "FRONT_ORDERS", "Order in which faces leave the front.");
  printEnum<Optimization>("Optimization", "OPTIMIZATIONS",
                          "Effort on the shape of the elements after the front has closed.");
  printEnum<Interior>("Interior", "INTERIORS", "What fills the deep inside of regions.");
  printEnum<PlaneStatus>("PlaneStatus", "PLANE_STATUSES", "How a fill of a polygon has ended.");
  printEnum<CheckedOption>("CheckedOption", "CHECKED_OPTIONS", "Options that the engine checks.");
  printEnum<Failure>("CallFailure", "CALL_FAILURES",
                     "Reason for which a call of the engine failed.");
  printTable<DiagnosticCode>("EngineCode", "ENGINE_CODES", "Code of a diagnostic of the engine.");
  printDiagnosticValues();
}

void printNumbers() {
  // The engine computes with magnitudes between two powers of 2; the documented limits are the powers of 10 within.
  printNumber("MAX_LENGTH", std::pow(10.0, std::floor(std::log10(kLargestCoordinate))),
              "Largest magnitude of coordinates and sizes.");
  printNumber("MIN_LENGTH", std::pow(10.0, std::ceil(std::log10(kSmallestExtent))),
              "Smallest size of models and elements.");
  printNumber("MAX_GROWTH", kMaxGrowth, "Largest growth of sizes per unit of distance.");
  printNumber("MAX_GRADATION", kMaxGradation,
              "Largest ratio of the sizes of neighbouring elements.");
  printNumber("MAX_STRETCHING", kMaxStretching, "Largest stretching.");
  printNumber("MAX_DIRECTION_COSINE", kMaxDirectionCosine,
              "Largest cosine of the angle between the two directions of a background node.");
  printNumber("MAX_HOLE_EDGES", kMaxHoleEdges,
              "Largest number of edges of a hole that a repair fills.");
  printNumber("MIN_REMESH_ANGLE", kMinRemeshAngle,
              "Smallest feature angle and angle per edge of a remeshing, in degrees.");
  printNumber("MAX_REMESH_ANGLE", kMaxRemeshAngle,
              "Largest feature angle and angle per edge of a remeshing, in degrees.");
  printNumber("SHADED_CELLS", kShadedCells, "Rows and columns of the lattice of a curved patch.");
  printNumber("MAX_SHADED_CELLS", kMaxShadedCells, "Largest number of rows of such a lattice.");
  printNumber("MAX_LAYERS", kMaxLayers, "Largest number of layers across thin walls.");
  printNumber("MIN_SIZE_FACTOR", kMinSizeFactor, "Smallest factor on the sizes of a remeshing.");
  printNumber("MAX_SIZE_FACTOR", kMaxSizeFactor, "Largest factor on the sizes of a remeshing.");
  printNumber("NO_REGION", SurfaceMesh::kNoRegion, "In `triangleRegions`: no region.");
  printNumber("NO_ORIGIN", kNoOrigin,
              "In `SurfaceInput.origin` and `nodeOrigin`: a triangle or node that the given "
              "surface does not have.");
  printNumber("DIHEDRAL_BIN_WIDTH", 180.0 / static_cast<double>(kDihedralBins),
              "Width of a bin of dihedral angles, in degrees.");
  printNumber("RATIO_BIN_WIDTH", 1.0 / static_cast<double>(kRatioBins),
              "Width of a bin of radius ratios.");
  printNumber("EDGE_BIN_WIDTH", 1.0 / static_cast<double>(kEdgeBinsPerTarget),
              "Width of a bin of edge length / target length.");
}

/// Prints what the scores of candidates are made of, in space and in the plane.
void printScoreRules() {
  printNumber("CLOSING_BONUS", kClosingBonus,
              "Bonus on the mean ratio for each edge at which a candidate meets a face.");
  printNumber("WEDGE_BONUS", kWedgeBonus, "Added to the score of the apex of a wedge.");
  printNumber("POCKET_BONUS", kPocketBonus, "Added to the score of a candidate at three edges.");
  printNumber("NEW_NODE_WEIGHT", kNewNodeWeight, "Weight of the mean ratio of a new node.");
  printNumber("LOW_NEW_NODE_WEIGHT", kLowNewNodeWeight, "The same in some attempts at a pocket.");
  std::string heights;
  for (const double height : kHeights) heights += (heights.empty() ? "" : ", ") + textOf(height);
  print("/** Heights tried for a new node, as factors of the ideal height. */");
  print("export const NEW_NODE_HEIGHTS = [" + heights + "] as const;");
  printNumber("CAPTURE_RADIUS", kCaptureRadius,
              "In the plane: distance within which a node replaces the ideal point, in lengths of "
              "the new edges.");
  printNumber("MIN_LENGTH_RATIO", kMinLengthRatio,
              "In the plane: smallest length of new edges / length of the base edge.");
  printNumber("MAX_LENGTH_RATIO", kMaxLengthRatio,
              "In the plane: largest length of new edges / length of the base edge.");
}

void printModule() {
  print("// Made by wasm/constants.cpp from the headers of the engine.\n");
  printEnums();
  printNumbers();
  printScoreRules();
  printDefaults<MeshOptions>("MESH_DEFAULTS", "Defaults of a run; a size of 0 means none.");
  printDefaults<InspectionOptions>("INSPECTION_DEFAULTS", "Defaults of an inspection.");
  printDefaults<RepairOptions>("REPAIR_DEFAULTS", "Defaults of a repair.");
  printDefaults<RemeshOptions>("REMESH_DEFAULTS",
                               "Defaults of a remeshing; 0, or a negative number of layers, leaves "
                               "the choice to the engine.");
  printDefaults<ImproveOptions>("IMPROVE_DEFAULTS", "Defaults of an improvement.");
  printDefaults<AdaptOptions>("ADAPT_DEFAULTS", "Defaults of an adaptation.");
  printDefaults<LayerOptions>("LAYER_DEFAULTS", "Defaults of layers along walls.");
  printDefaults<PatchLayers>("PATCH_LAYERS_DEFAULTS", "Defaults of the layers of one patch.");
  printDefaults<PlaneOptions>("PLANE_DEFAULTS", "Defaults of the fill of a polygon.");
  printDefaults<ProposalOptions>("PROPOSAL_DEFAULTS",
                                 "Defaults of size proposals; 0 leaves a size to the engine.");
  printDefaults<SolutionMetricOptions>("SOLUTION_SIZE_DEFAULTS", "Defaults of sizes from fields.");
  printNumber("SOURCE_GROWTH", SizeSource{}.growth, "Default growth of a source.");
  printType<Model>("ModelArrays", "A drawn model.");
  printType<BodySurfaces>("BodySurfaceArrays", "The surfaces of all bodies, in one.");
  printType<BackgroundGrid>("GridArrays", "A background grid.");
  printType<FrontSizes>("FrontSizes", "Sizes of the front from metrics.");
  printType<std::vector<Diagnostic>>("DiagnosticArrays", "Diagnostics of an answer.");
}

}  // namespace
}  // namespace tetrafront::border

int main() { tetrafront::border::printModule(); }
