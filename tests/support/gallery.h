#pragma once

/// @file The bundled models, read from their project files.

#include <string>
#include <vector>

#include "tetrafront/model.h"

namespace tetrafront::testing {

struct GalleryModel {
  std::string name;  ///< of the file, without its ending
  Model model;
  std::vector<std::string> patchNames;
};

/// All of them, by name.
std::vector<GalleryModel> galleryModels();

}  // namespace tetrafront::testing
