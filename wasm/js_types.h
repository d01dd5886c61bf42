#pragma once

/// @file How values of C++ cross the border, and their TypeScript types:
///
///     bool                              boolean
///     numbers, enums                    number
///     Vec3                              [number, number, number]
///     std::array                        array of all its numbers
///     std::vector of numbers            Uint8Array, Uint16Array, Uint32Array,
///                                       Float32Array or Float64Array
///     std::vector<Vec3>, of std::array  the same, all numbers one after the other
///     struct                            object with the same fields
///     std::vector of structs            array of objects
///     the same, if kInColumns           object with one array per field, for structs of which there may be
///                                       a million
///
/// In columns, a bool is 0 or 1, and a field that is itself a vector becomes `lengths`, its length per struct, and
/// `items`, all its elements one after the other.

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "reflection.h"
#include "tetrafront/background_grid.h"
#include "tetrafront/model.h"
#include "tetrafront/status.h"
#include "tetrafront/surface_tools.h"
#include "tetrafront/vec3.h"

namespace tetrafront::border {

/// True for structs whose vectors cross as columns.
template <class T>
inline constexpr bool kInColumns = false;
template <>
inline constexpr bool kInColumns<BackgroundNode> = true;
template <>
inline constexpr bool kInColumns<SecondStretching> = true;
template <>
inline constexpr bool kInColumns<Diagnostic> = true;
template <>
inline constexpr bool kInColumns<Line> = true;
template <>
inline constexpr bool kInColumns<Patch> = true;
template <>
inline constexpr bool kInColumns<RepairChange> = true;
template <>
inline constexpr bool kInColumns<SizeSource> = true;

/// Type of the numbers that a value consists of; they are contiguous in memory.
template <class T>
struct NumbersOf;
template <class T>
  requires std::is_arithmetic_v<T>
struct NumbersOf<T> {
  using Type = T;
};
template <>
struct NumbersOf<bool> {
  static_assert(sizeof(bool) == 1);
  using Type = std::uint8_t;
};
template <class T>
  requires std::is_enum_v<T>
struct NumbersOf<T> {
  using Type = std::underlying_type_t<T>;
};
template <>
struct NumbersOf<Vec3> {
  using Type = double;
};
template <class T, std::size_t N>
struct NumbersOf<std::array<T, N>> {
  using Type = typename NumbersOf<T>::Type;
};
template <class T>
using NumberOf = typename NumbersOf<T>::Type;

template <class T>
concept Numeric = requires { typename NumbersOf<T>::Type; };

/// Number of numbers of a value.
template <Numeric T>
inline constexpr std::size_t kWidth = sizeof(T) / sizeof(NumberOf<T>);

template <class T>
inline constexpr bool kIsVector = false;
template <class T>
inline constexpr bool kIsVector<std::vector<T>> = true;

/// True for vectors that cross as an array of objects.
template <class T>
inline constexpr bool kIsArrayOfObjects = false;
template <Record T>
  requires(!Numeric<T> && !kInColumns<T>)
inline constexpr bool kIsArrayOfObjects<std::vector<T>> = true;

/// Returns the class of JavaScript's arrays of T.
template <class T>
consteval std::string_view arrayClass() {
  if constexpr (std::is_same_v<T, double>) {
    return "Float64Array";
  } else if constexpr (std::is_same_v<T, float>) {
    return "Float32Array";
  } else if constexpr (std::is_same_v<T, std::uint32_t>) {
    return "Uint32Array";
  } else if constexpr (std::is_same_v<T, std::uint16_t>) {
    return "Uint16Array";
  } else {
    static_assert(std::is_same_v<T, std::uint8_t>);
    return "Uint8Array";
  }
}

/// Returns the type of an object with the fields of T; `typeOf` returns that of a field.
template <Record T, class TypeOf>
consteval std::string objectType(const TypeOf& typeOf) {
  std::string text = "{ ";
  forEachField<T>([&](auto index) {
    constexpr std::size_t kIndex = decltype(index)::value;
    text += std::string(fieldName<T, kIndex>()) + ": ";
    text += typeOf.template operator()<FieldType<T, kIndex>>() + "; ";
  });
  return text + "}";
}

/// Returns the type of vectors of T in columns.
template <class T>
consteval std::string columnType() {
  if constexpr (Numeric<T>) {
    return std::string(arrayClass<NumberOf<T>>());
  } else if constexpr (kIsVector<T>) {
    return "{ lengths: Uint32Array; items: " + columnType<typename T::value_type>() + " }";
  } else {
    return objectType<T>([]<class Field>() { return columnType<Field>(); });
  }
}

/// Returns the TypeScript type of a T that has crossed the border.
template <class T>
consteval std::string typeScriptType() {
  if constexpr (std::is_same_v<T, bool>) {
    return "boolean";
  } else if constexpr (std::is_arithmetic_v<T> || std::is_enum_v<T>) {
    return "number";
  } else if constexpr (std::is_same_v<T, Vec3>) {
    return "[number, number, number]";
  } else if constexpr (Numeric<T>) {
    return "number[]";
  } else if constexpr (kIsArrayOfObjects<T>) {
    return typeScriptType<typename T::value_type>() + "[]";
  } else if constexpr (kIsVector<T>) {
    return columnType<typename T::value_type>();
  } else {
    return objectType<T>([]<class Field>() { return typeScriptType<Field>(); });
  }
}

/// Returns the same text as an array that ends with 0.
template <class T>
consteval auto typeScriptText() {
  return terminated<typeScriptType<T>().size()>(typeScriptType<T>());
}

template <class T>
inline constexpr auto kTypeScriptType = typeScriptText<T>();

}  // namespace tetrafront::border
