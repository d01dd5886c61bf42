#include "support/gallery.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <stdexcept>
#include <utility>

namespace tetrafront::testing {

namespace {

/// A value of a JSON file; no more of the format than the project files use.
struct Json {
  double number = 0.0;
  std::string text;
  std::vector<Json> items;
  std::map<std::string, Json> members;

  [[nodiscard]] const Json& at(const std::string& name) const { return members.at(name); }
};

class JsonReader {
 public:
  explicit JsonReader(std::string text) : text_(std::move(text)) {}

  Json value() {
    Json found;
    switch (peek()) {
      case '{':
        readSequence('}', [&] {
          const std::string name = quoted();
          expect(':');
          found.members.emplace(name, value());
        });
        break;
      case '[':
        readSequence(']', [&] { found.items.push_back(value()); });
        break;
      case '"':
        found.text = quoted();
        break;
      default:
        found.number = number();
    }
    return found;
  }

 private:
  char peek() {
    while (std::isspace(static_cast<unsigned char>(text_.at(next_))) != 0) ++next_;
    return text_[next_];
  }

  void expect(char wanted) {
    if (peek() != wanted) throw std::runtime_error(std::string("no ") + wanted);
    ++next_;
  }

  template <class ReadItem>
  void readSequence(char end, ReadItem&& readItem) {
    ++next_;
    while (peek() != end) {
      readItem();
      if (peek() == ',') ++next_;
    }
    ++next_;
  }

  std::string quoted() {
    expect('"');
    const std::size_t from = next_;
    while (text_.at(next_) != '"') next_ += text_[next_] == '\\' ? 2 : 1;
    return text_.substr(from, next_++ - from);
  }

  double number() {
    const char* const from = text_.c_str() + next_;
    char* end = nullptr;
    const double found = std::strtod(from, &end);
    if (end == from) throw std::runtime_error("no value");
    next_ += static_cast<std::size_t>(end - from);
    return found;
  }

  std::string text_;
  std::size_t next_ = 0;
};

using Numbers = std::map<double, std::uint32_t>;  ///< positions by the file's ids

LineType lineTypeOf(const std::string& name) {
  static const std::map<std::string, LineType> types{
      {"straight", LineType::kStraight}, {"parabolic", LineType::kParabolic},
      {"spline", LineType::kSpline},     {"arc", LineType::kArc},
      {"circle", LineType::kCircle},     {"hermite", LineType::kHermite}};
  return types.at(name);
}

PatchType patchTypeOf(const std::string& name) {
  static const std::map<std::string, PatchType> types{
      {"planar", PatchType::kPlanar},
      {"isoparametric-triangle", PatchType::kIsoparametricTriangle},
      {"serendipity", PatchType::kSerendipity},
      {"barnhill-gregory-nielson", PatchType::kBarnhillGregoryNielson},
      {"coons", PatchType::kCoons},
      {"tube", PatchType::kTube},
      {"gregory", PatchType::kGregory},
      {"nielson", PatchType::kNielson},
      {"loft", PatchType::kLoft}};
  return types.at(name);
}

Numbers positionsOf(const Json& list) {
  Numbers positions;
  for (std::uint32_t i = 0; i < list.items.size(); ++i)
    positions[list.items[i].at("id").number] = i;
  return positions;
}

GalleryModel modelOf(const Json& project) {
  GalleryModel read;
  for (const Json& point : project.at("points").items) {
    const std::vector<Json>& at = point.at("position").items;
    read.model.points.emplace_back(at[0].number, at[1].number, at[2].number);
  }
  const Numbers points = positionsOf(project.at("points"));
  for (const Json& line : project.at("lines").items) {
    Line& drawn = read.model.lines.emplace_back();
    drawn.type = lineTypeOf(line.at("type").text);
    for (const Json& point : line.at("points").items)
      drawn.points.push_back(points.at(point.number));
  }
  const Numbers lines = positionsOf(project.at("lines"));
  for (const Json& patch : project.at("patches").items) {
    Patch& drawn = read.model.patches.emplace_back();
    drawn.type = patchTypeOf(patch.at("type").text);
    for (const Json& loop : patch.at("loops").items) {
      const bool isSection = drawn.type == PatchType::kLoft && !drawn.loops.empty();
      Loop& walked = isSection ? drawn.sections : drawn.loops.emplace_back();
      for (const Json& line : loop.items)
        walked.push_back({lines.at(std::fabs(line.number)), line.number < 0.0});
    }
    read.patchNames.push_back(patch.at("name").text);
  }
  return read;
}

}  // namespace

GalleryModel readGalleryModel(const std::string& path) {
  std::ostringstream text;
  text << std::ifstream(path).rdbuf();
  GalleryModel read = modelOf(JsonReader(text.str()).value());
  read.name = std::filesystem::path(path).stem().string();
  return read;
}

#ifdef TETRAFRONT_GALLERY

std::vector<GalleryModel> galleryModels() {
  std::vector<GalleryModel> models;
  for (const auto& entry : std::filesystem::directory_iterator(TETRAFRONT_GALLERY)) {
    models.push_back(readGalleryModel(entry.path().string()));
  }
  std::ranges::sort(models, {}, &GalleryModel::name);
  return models;
}

#endif

}  // namespace tetrafront::testing
