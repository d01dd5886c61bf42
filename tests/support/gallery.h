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

/// Returns the drawn model of a project file, which must be valid. Throws std::exception if it cannot be read.
GalleryModel readGalleryModel(const std::string& path);

/// Returns all bundled models, sorted by name.
std::vector<GalleryModel> galleryModels();

}  // namespace tetrafront::testing
