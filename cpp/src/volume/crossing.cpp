#include "volume/crossing.h"

#include <algorithm>

#include "geom/predicates.h"

namespace tetrafront {
namespace {

// A corner is on three planes of the element and counts as outside of them, because it may be
// shared. It is not outside the plane of the opposite face.
constexpr std::array<std::uint8_t, 4> kCornerMask{14, 13, 11, 7};

/// Returns the sign of the permutation that sorts four distinct numbers.
int permutationSign(int a, int b, int c, int d) {
  const std::array<int, 4> p{a, b, c, d};
  int sign = 1;
  for (int i = 0; i < 4; ++i) {
    for (int j = i + 1; j < 4; ++j) {
      if (p[i] > p[j]) sign = -sign;
    }
  }
  return sign;
}

/// Returns the two corners other than `i` and `j`, ascending.
std::array<int, 2> otherCorners(int i, int j) {
  std::array<int, 2> others{};
  int count = 0;
  for (int k = 0; k < 4; ++k) {
    if (k != i && k != j) others[count++] = k;
  }
  return others;
}

/// Collects signs and shows whether both occur.
struct SignRange {
  bool anyPositive = false;
  bool anyNegative = false;
  void add(int sign) {
    anyPositive = anyPositive || sign > 0;
    anyNegative = anyNegative || sign < 0;
  }
  [[nodiscard]] bool mixed() const { return anyPositive && anyNegative; }
};

}  // namespace

void CrossingTest::setBase() {
  const std::size_t count = around_.nodeCount();
  baseMask_.resize(count + 1);
  mask_.resize(count + 1);
  const Vec3 a = around_.position(0);
  const Vec3 n = glm::cross(around_.position(1) - a, around_.position(2) - a);
  normals_[3] = n;
  const double error = around_.determinantError();
  const double* x = around_.x();
  const double* y = around_.y();
  const double* z = around_.z();
  std::uint8_t* mask = baseMask_.data();
  for (std::size_t i = 0; i < count; ++i) {
    const double distance = n.x * (x[i] - a.x) + n.y * (y[i] - a.y) + n.z * (z[i] - a.z);
    mask[i] = distance < -error ? kBaseBit : 0;
  }
  for (int k = 0; k < 3; ++k) baseMask_[k] = kCornerMask[k];
}

int CrossingTest::provenSign(double determinant) const {
  if (!filters_) return 0;
  const double error = around_.determinantError();
  return determinant > error ? 1 : (determinant < -error ? -1 : 0);
}

int CrossingTest::volumeSign(LocalNode apex) const {
  const double volume = glm::dot(normals_[3], around_.position(apex) - around_.position(0));
  const int sign = provenSign(volume);
  return sign != 0 ? sign : orient(0, 1, 2, apex);
}

void CrossingTest::setApex(LocalNode apex) {
  corners_[3] = apex;
  const Vec3 p = around_.position(apex);
  const Vec3 a = around_.position(0) - p;
  const Vec3 b = around_.position(1) - p;
  const Vec3 c = around_.position(2) - p;
  normals_[0] = glm::cross(c, b);
  normals_[1] = glm::cross(a, c);
  normals_[2] = glm::cross(b, a);
  if (filters_) {
    maskNodes();
  } else {
    std::fill(mask_.begin(), mask_.end(), std::uint8_t{0});
  }
  for (int k = 0; k < 4; ++k) mask_[corners_[k]] = kCornerMask[k];
}

void CrossingTest::maskNodes() {
  const std::size_t count = around_.nodeCount();
  const Vec3 p = around_.position(corners_[3]);
  const Vec3 n0 = normals_[0];
  const Vec3 n1 = normals_[1];
  const Vec3 n2 = normals_[2];
  const double error = around_.determinantError();
  const double* xs = around_.x();
  const double* ys = around_.y();
  const double* zs = around_.z();
  const std::uint8_t* base = baseMask_.data();
  std::uint8_t* mask = mask_.data();
  for (std::size_t i = 0; i < count; ++i) {
    const double x = xs[i] - p.x;
    const double y = ys[i] - p.y;
    const double z = zs[i] - p.z;
    const double d0 = n0.x * x + n0.y * y + n0.z * z;
    const double d1 = n1.x * x + n1.y * y + n1.z * z;
    const double d2 = n2.x * x + n2.y * y + n2.z * z;
    mask[i] = static_cast<std::uint8_t>(base[i] | (d0 < -error ? 1 : 0) | (d1 < -error ? 2 : 0) |
                                        (d2 < -error ? 4 : 0));
  }
}

FaceId CrossingTest::firstCrossedFace() {
  const std::size_t count = around_.faceCount();
  for (std::size_t i = 0; i < count; ++i) {
    ++counters_.facesTested;
    const LocalTriple& face = around_.face(i);
    if (filters_ && (mask_[face[0]] & mask_[face[1]] & mask_[face[2]]) != 0) continue;
    ++counters_.facesAnalysed;
    if (crosses(face)) return around_.faceId(i);
  }
  return {};
}

int CrossingTest::orient(LocalNode a, LocalNode b, LocalNode c, LocalNode d) const {
  return orient3d(around_.position(a), around_.position(b), around_.position(c),
                  around_.position(d));
}

int CrossingTest::faceSign(int plane, LocalNode node) const {
  if ((mask_[node] >> plane & 1) != 0) return -1;
  const Vec3 through = around_.position(plane == 3 ? 0 : corners_[3]);
  const double distance = glm::dot(normals_[plane], around_.position(node) - through);
  const int sign = provenSign(distance);
  if (sign != 0) return sign;
  switch (plane) {
    case 0:
      return orient(node, 1, 2, corners_[3]);
    case 1:
      return orient(0, node, 2, corners_[3]);
    case 2:
      return orient(0, 1, node, corners_[3]);
    default:
      return orient(0, 1, 2, node);
  }
}

CrossingTest::Signs CrossingTest::cornerSigns(const LocalTriple& face, const Shared& shared) const {
  const Vec3 a = around_.position(face[0]);
  const Vec3 normal = glm::cross(around_.position(face[1]) - a, around_.position(face[2]) - a);
  Signs signs{};
  for (int i = 0; i < 4; ++i) {
    if (std::find(shared.begin(), shared.end(), i) != shared.end()) continue;
    const double distance = glm::dot(normal, around_.position(corners_[i]) - a);
    signs[i] = provenSign(distance);
    if (signs[i] == 0) signs[i] = orient(face[0], face[1], face[2], corners_[i]);
  }
  return signs;
}

bool CrossingTest::crosses(const LocalTriple& face) const {
  Shared shared{};
  int sharedCount = 0;
  int lastShared = 0;
  for (int i = 0; i < 3; ++i) {
    const auto at = std::find(corners_.begin(), corners_.end(), face[i]);
    shared[i] = at == corners_.end() ? kNotShared : static_cast<int>(at - corners_.begin());
    if (shared[i] == kNotShared) continue;
    ++sharedCount;
    lastShared = i;
  }
  if (sharedCount == 3) return false;
  if (sharedCount == 2) return crossesAtEdge(face, shared);

  const Signs corners = cornerSigns(face, shared);
  SignRange range;
  bool onPlane = false;
  for (int i = 0; i < 4; ++i) {
    if (sharedCount == 1 && i == shared[lastShared]) continue;
    range.add(corners[i]);
    onPlane = onPlane || corners[i] == 0;
  }
  if (!range.mixed() && !onPlane) return false;
  return sharedCount == 1 ? crossesAtNode(face, lastShared, shared[lastShared], corners)
                          : crossesApart(face, corners);
}

bool CrossingTest::crossesAtEdge(const LocalTriple& face, const Shared& shared) const {
  LocalNode third = 0;
  std::array<bool, 4> onEdge{};
  for (int i = 0; i < 3; ++i) {
    if (shared[i] == kNotShared) {
      third = face[i];
    } else {
      onEdge[shared[i]] = true;
    }
  }
  // The planes that contain the common edge are those of the corners off it.
  for (int plane = 0; plane < 4; ++plane) {
    if (!onEdge[plane] && faceSign(plane, third) < 0) return false;
  }
  return true;
}

bool CrossingTest::crossesAtNode(const LocalTriple& face, int faceCorner, int elementCorner,
                                 const Signs& corners) const {
  const int k = elementCorner;
  const LocalNode v = face[(faceCorner + 1) % 3];
  const LocalNode w = face[(faceCorner + 2) % 3];
  Signs atV{};
  Signs atW{};
  bool vInCone = true;
  bool wInCone = true;
  for (int plane = 0; plane < 4; ++plane) {
    if (plane == k) continue;
    atV[plane] = faceSign(plane, v);
    atW[plane] = faceSign(plane, w);
    if (atV[plane] < 0 && atW[plane] < 0) return false;
    vInCone = vInCone && atV[plane] >= 0;
    wInCone = wInCone && atW[plane] >= 0;
  }
  if (vInCone || wInCone) return true;
  for (int plane = 0; plane < 4; ++plane) {
    if (plane == k) continue;
    const std::array<int, 2> rays = otherCorners(k, plane);
    if (atV[plane] == 0 && atW[plane] == 0) {
      if (sectorsOverlap(v, w, k, plane, rays)) return true;
      continue;
    }
    // v and w are outside the cone. If one of them is on the plane, the sector does not reach the
    // cone there.
    if (atV[plane] == 0 || atW[plane] == 0 || atV[plane] == atW[plane]) continue;
    // The arcs v-w and ray-ray cross iff the triples (v r0 w) (r0 w r1) (w r1 v) (r1 v r0) all have
    // the same orientation. A plain test for opposite signs would also accept antipodal arcs.
    const int orientation = atV[plane] * permutationSign(k, rays[0], rays[1], plane);
    if (orientation * corners[rays[0]] <= 0 && orientation * corners[rays[1]] >= 0) return true;
  }
  return false;
}

/// v, w and the two rays from the centre lie in one plane, v and w outside the sector of the rays.
/// The sectors overlap iff a ray is between v and w. The corner off that plane gives signs in the
/// plane.
bool CrossingTest::sectorsOverlap(LocalNode v, LocalNode w, int centre, int offPlane,
                                  const std::array<int, 2>& rays) const {
  const LocalNode x = corners_[centre];
  const LocalNode up = corners_[offPlane];
  const LocalNode ray = corners_[rays[0]];
  const int vToRay = orient(x, up, v, ray);
  const int rayToW = orient(x, up, ray, w);
  const int vToW = orient(x, up, v, w);
  return vToRay * vToW >= 0 && rayToW * vToW >= 0;
}

/// The ends of the segment must not be strictly on one side of the triangle's plane, nor both on
/// it.
bool CrossingTest::segmentIntersectsTriangle(LocalNode from, LocalNode to,
                                             const LocalTriple& triangle) const {
  SignRange range;
  for (int i = 0; i < 3; ++i) range.add(orient(from, to, triangle[i], triangle[(i + 1) % 3]));
  return !range.mixed();
}

bool CrossingTest::crossesApart(const LocalTriple& face, const Signs& corners) const {
  std::array<Signs, 3> at{};
  for (int i = 0; i < 3; ++i) {
    bool inside = true;
    for (int plane = 0; plane < 4; ++plane) {
      at[i][plane] = faceSign(plane, face[i]);
      inside = inside && at[i][plane] >= 0;
    }
    if (inside) return true;
  }
  for (int i = 0; i < 3; ++i) {
    const Signs& from = at[i];
    const Signs& to = at[(i + 1) % 3];
    bool separated = false;
    for (int plane = 0; plane < 4; ++plane)
      separated = separated || (from[plane] < 0 && to[plane] < 0);
    if (separated) continue;
    for (int plane = 0; plane < 4; ++plane) {
      if (from[plane] == to[plane]) continue;
      LocalTriple triangle{};
      int count = 0;
      for (int k = 0; k < 4; ++k) {
        if (k != plane) triangle[count++] = corners_[k];
      }
      if (segmentIntersectsTriangle(face[i], face[(i + 1) % 3], triangle)) return true;
    }
  }
  for (int i = 0; i < 4; ++i) {
    for (int j = i + 1; j < 4; ++j) {
      if (corners[i] == corners[j]) continue;
      if (segmentIntersectsTriangle(corners_[i], corners_[j], face)) return true;
    }
  }
  return false;
}

}  // namespace tetrafront
