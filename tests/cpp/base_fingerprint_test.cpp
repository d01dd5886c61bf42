#include "base/fingerprint.h"

#include <gtest/gtest.h>

#include <array>
#include <cstdint>

namespace tetrafront {
namespace {

std::uint64_t fingerprintOf(std::span<const double> values) {
  Fingerprint fingerprint;
  fingerprint.add(values);
  return fingerprint.value();
}

TEST(Fingerprint, IsFnv1aOfTheLittleEndianBytes) {
  Fingerprint fingerprint;
  EXPECT_EQ(fingerprint.value(), 0xcbf29ce484222325U) << "the offset basis of 64-bit FNV-1a";
  fingerprint.add(std::uint64_t{0x0123456789abcdefU});
  EXPECT_EQ(fingerprint.value(), 0x37eb3f3347761c55U) << "computed with arbitrary-size integers";
}

TEST(Fingerprint, DependsOnOrderAndOnTheLastBit) {
  const std::array<double, 2> forth = {1.0, 2.0};
  const std::array<double, 2> back = {2.0, 1.0};
  const std::array<double, 2> nudged = {1.0, 2.0000000000000004};
  EXPECT_NE(fingerprintOf(forth), fingerprintOf(back));
  EXPECT_NE(fingerprintOf(forth), fingerprintOf(nudged));
}

TEST(Fingerprint, TreatsBothZerosAsTheSameCoordinate) {
  const std::array<double, 1> plus = {0.0};
  const std::array<double, 1> minus = {-0.0};
  EXPECT_EQ(fingerprintOf(plus), fingerprintOf(minus));
}

}  // namespace
}  // namespace tetrafront
