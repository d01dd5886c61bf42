#pragma once

/// @file The bundled models, read from their project files.

#include <string>
#include <vector>

#include "tetrafront/model.h"

namespace tetrafront::testing {

struct GalleryModel {
  std::string name;  ///< name of the file without extension
  Model model;
  std::vector<std::string> patchNames;
};

/// Returns all bundled models, sorted by name.
std::vector<GalleryModel> galleryModels();

}  // namespace tetrafront::testing
