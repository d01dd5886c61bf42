#include "support/stored_fingerprints.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdlib>
#include <fstream>
#include <ios>
#include <map>
#include <sstream>

#include "base/fingerprint.h"

namespace tetrafront::testing {
namespace {

struct Stored {
  std::size_t nodes = 0;
  std::size_t triangles = 0;
  std::uint64_t body = 0;
  std::uint64_t mesh = 0;
};

Stored fingerprintsOf(const SurfaceMesh& body, std::uint64_t mesh) {
  Fingerprint fingerprint;
  fingerprint.add(body.points);
  fingerprint.add(body.triangles);
  return {body.points.size() / 3, body.triangles.size() / 3, fingerprint.value(), mesh};
}

/// One body per line: its name, its numbers of nodes and triangles, and the two fingerprints.
std::map<std::string, Stored> readStored() {
  std::map<std::string, Stored> bodies;
  std::ifstream file(TETRAFRONT_FINGERPRINTS);
  std::string line;
  while (std::getline(file, line)) {
    std::istringstream words(line);
    std::string name;
    Stored stored;
    words >> name >> stored.nodes >> stored.triangles >> std::hex >> stored.body >> stored.mesh;
    if (words) bodies[name] = stored;
  }
  return bodies;
}

/// The bodies of one process come in one order, so that the file changes only where meshes do.
void store(const std::string& name, const Stored& made) {
  std::ofstream file(TETRAFRONT_FINGERPRINTS, std::ios::app);
  file << name << ' ' << made.nodes << ' ' << made.triangles << ' ' << std::hex << made.body << ' '
       << made.mesh << '\n';
}

}  // namespace

void expectStoredFingerprint(const std::string& name, const SurfaceMesh& body, std::uint64_t mesh) {
  const Stored made = fingerprintsOf(body, mesh);
  if (std::getenv("TETRAFRONT_STORE_FINGERPRINTS") != nullptr) {
    store(name, made);
    return;
  }
  static const std::map<std::string, Stored> kBodies = readStored();
  const auto found = kBodies.find(name);
  if (found == kBodies.end()) {
    ADD_FAILURE() << name << " has no stored fingerprint: npm run fingerprints";
    return;
  }
  const Stored& stored = found->second;
  EXPECT_EQ(made.nodes, stored.nodes) << name;
  EXPECT_EQ(made.triangles, stored.triangles) << name;
  if (made.body != stored.body) return;
  EXPECT_EQ(made.mesh, stored.mesh)
      << "The mesh of " << name << " has changed. If that is right: npm run fingerprints";
}

}  // namespace tetrafront::testing
