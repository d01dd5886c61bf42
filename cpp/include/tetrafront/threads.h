#pragma once

/// @file Threads for a run, in native builds. WebAssembly has none: its hosts give tiles to other engines (tile_host.h).

#include "tetrafront/mesher.h"

namespace tetrafront {

/// Lets a run optimize tiles of a large mesh on `count` threads, at least 1. The mesh is the same, bit for bit, for any number. Call it before
/// the first MeshRun::advance(), which then returns several times a second while the threads work.
void useThreads(MeshRun& run, unsigned count);

}  // namespace tetrafront
