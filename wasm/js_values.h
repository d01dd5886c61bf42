#pragma once

/// @file Converts values of C++ to JavaScript and back, in the forms that js_types.h lists. Arrays are always copied:
/// a view into the heap becomes invalid when memory grows.

#include <emscripten/val.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <type_traits>
#include <utility>
#include <vector>

#include "js_types.h"
#include "reflection.h"

namespace tetrafront::border {

using emscripten::val;

/// A field of all elements of a vector, or the elements themselves.
template <class T>
struct Column {
  using Byte = std::conditional_t<std::is_const_v<T>, const std::byte, std::byte>;
  Byte* first;
  std::size_t count;
  std::size_t stride;  ///< bytes from one to the next

  [[nodiscard]] T& operator[](std::size_t i) const {
    return *reinterpret_cast<T*>(first + i * stride);
  }
};

template <class T>
[[nodiscard]] Column<const T> columnOf(const std::vector<T>& elements) {
  return {reinterpret_cast<const std::byte*>(elements.data()), elements.size(), sizeof(T)};
}

template <class T>
[[nodiscard]] Column<T> columnOf(std::vector<T>& elements) {
  return {reinterpret_cast<std::byte*>(elements.data()), elements.size(), sizeof(T)};
}

/// Returns field I of all elements.
template <std::size_t I, class T>
[[nodiscard]] auto fieldColumn(const Column<T>& column) {
  using Field = FieldType<std::remove_const_t<T>, I>;
  const std::size_t offset = fieldOffset<std::remove_const_t<T>, I>();
  return Column<std::conditional_t<std::is_const_v<T>, const Field, Field>>{
      column.first + offset, column.count, column.stride};
}

// ---- from C++ to JavaScript

/// Returns a typed array with copies of the numbers.
template <class T>
[[nodiscard]] val arrayOf(const T* first, std::size_t count) {
  return val(emscripten::typed_memory_view(count, first)).template call<val>("slice");
}

/// Copies `bytes` bytes of each of `count` elements to `to`, without gaps.
inline void gather(const std::byte* from, std::size_t count, std::size_t stride, std::size_t bytes,
                   void* to) {
  for (std::size_t i = 0; i < count; ++i) {
    std::memcpy(static_cast<std::byte*>(to) + i * bytes, from + i * stride, bytes);
  }
}

template <class T>
[[nodiscard]] val toJs(const Column<const T>& column) {
  if constexpr (Numeric<T>) {
    using Number = NumberOf<T>;
    const std::size_t count = kWidth<T> * column.count;
    if (column.stride == sizeof(T)) {
      return arrayOf(reinterpret_cast<const Number*>(column.first), count);
    }
    std::vector<Number> numbers(count);
    gather(column.first, column.count, column.stride, sizeof(T), numbers.data());
    return arrayOf(numbers.data(), count);
  } else if constexpr (kIsVector<T>) {
    std::vector<std::uint32_t> lengths;
    lengths.reserve(column.count);
    T items;
    for (std::size_t i = 0; i < column.count; ++i) {
      lengths.push_back(static_cast<std::uint32_t>(column[i].size()));
      items.insert(items.end(), column[i].begin(), column[i].end());
    }
    val both = val::object();
    both.set("lengths", toJs(columnOf(std::as_const(lengths))));
    both.set("items", toJs(columnOf(std::as_const(items))));
    return both;
  } else {
    val object = val::object();
    forEachField<T>([&](auto index) {
      constexpr std::size_t kIndex = decltype(index)::value;
      object.set(kFieldName<T, kIndex>.data(), toJs(fieldColumn<kIndex>(column)));
    });
    return object;
  }
}

/// Returns the value in its form for JavaScript: a bool, a double or a val.
template <class T>
[[nodiscard]] auto toJs(const T& value) {
  if constexpr (std::is_same_v<T, bool>) {
    return value;
  } else if constexpr (std::is_arithmetic_v<T> || std::is_enum_v<T>) {
    return static_cast<double>(value);
  } else if constexpr (Numeric<T>) {
    const auto* first = reinterpret_cast<const NumberOf<T>*>(&value);
    return val::array(first, first + kWidth<T>);
  } else if constexpr (kIsArrayOfObjects<T>) {
    val array = val::array();
    for (const auto& element : value) array.call<void>("push", toJs(element));
    return array;
  } else if constexpr (kIsVector<T>) {
    return toJs(columnOf(value));
  } else {
    val object = val::object();
    const auto fields = fieldsOf(value);
    forEachField<T>([&](auto index) {
      constexpr std::size_t kIndex = decltype(index)::value;
      object.set(kFieldName<T, kIndex>.data(), toJs(std::get<kIndex>(fields)));
    });
    return object;
  }
}

// ---- from JavaScript to C++

/// Returns the length of the vector that the columns hold.
template <class T>
[[nodiscard]] std::size_t lengthOf(const val& columns) {
  if constexpr (Numeric<T>) {
    return columns["length"].as<std::size_t>() / kWidth<T>;
  } else if constexpr (kIsVector<T>) {
    return lengthOf<std::uint32_t>(columns["lengths"]);
  } else {
    return lengthOf<FieldType<T, 0>>(columns[kFieldName<T, 0>.data()]);
  }
}

/// The inverse of gather().
inline void scatter(const void* from, std::size_t count, std::size_t stride, std::size_t bytes,
                    std::byte* to) {
  for (std::size_t i = 0; i < count; ++i) {
    std::memcpy(to + i * stride, static_cast<const std::byte*>(from) + i * bytes, bytes);
  }
}

template <class T>
void fromJs(const val& source, std::vector<T>& elements);

/// Sets the values of a column; if the array is shorter, the others keep theirs.
template <class T>
void fromJs(const val& source, const Column<T>& column) {
  if constexpr (Numeric<T>) {
    using Number = NumberOf<T>;
    if (column.stride == sizeof(T)) {
      const std::size_t count = kWidth<T> * column.count;
      const val view(emscripten::typed_memory_view(count, reinterpret_cast<Number*>(column.first)));
      // A point of an unfinished project may lack coordinates: ignore numbers that do not fill an element.
      view.call<void>("set", source.call<val>("subarray", 0, count));
      return;
    }
    const auto numbers = emscripten::convertJSArrayToNumberVector<Number>(source);
    const std::size_t count = std::min(column.count, numbers.size() / kWidth<T>);
    scatter(numbers.data(), count, column.stride, sizeof(T), column.first);
  } else if constexpr (kIsVector<T>) {
    std::vector<std::uint32_t> lengths;
    fromJs(source["lengths"], lengths);
    T items;
    fromJs(source["items"], items);
    auto next = items.begin();
    for (std::size_t i = 0; i < std::min(column.count, lengths.size()); ++i) {
      const auto end = next + std::min<std::ptrdiff_t>(lengths[i], items.end() - next);
      column[i].assign(next, end);
      next = end;
    }
  } else {
    forEachField<T>([&](auto index) {
      constexpr std::size_t kIndex = decltype(index)::value;
      fromJs(source[kFieldName<T, kIndex>.data()], fieldColumn<kIndex>(column));
    });
  }
}

/// Sets a value from its form for JavaScript. Vectors must hold numbers or cross in columns.
template <class T>
void fromJs(const val& source, T& value) {
  if constexpr (std::is_same_v<T, bool>) {
    value = source.as<bool>();
  } else if constexpr (std::is_arithmetic_v<T> || std::is_enum_v<T>) {
    value = static_cast<T>(source.as<double>());
  } else {
    const auto fields = fieldsOf(value);
    forEachField<T>([&](auto index) {
      constexpr std::size_t kIndex = decltype(index)::value;
      static_assert(!kIsArrayOfObjects<FieldType<T, kIndex>>, "add the struct to kInColumns");
      fromJs(source[kFieldName<T, kIndex>.data()], std::get<kIndex>(fields));
    });
  }
}

template <class T>
void fromJs(const val& source, std::vector<T>& elements) {
  elements.resize(lengthOf<T>(source));
  fromJs(source, columnOf(elements));
}

/// A T as a JavaScript value. Its own type, so that engine.d.ts states the TypeScript type instead of `any`.
template <class T>
struct Js : val {
  explicit Js(const val& given) : val(given) {}
  explicit Js(const T& value) : val(toJs(value)) {}

  [[nodiscard]] T value() const {
    T result{};
    fromJs(*this, result);
    return result;
  }
};

}  // namespace tetrafront::border
