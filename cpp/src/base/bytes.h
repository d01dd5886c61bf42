#pragma once

/// @file Values as bytes, and back: what one engine hands to another of the same build, in another worker or process. Numbers, structs of
/// numbers, vectors of them, and classes that name their members with
///
///     template <class Self, class Visit>
///     static void visitMembers(Self& self, Visit& visit) { visit(self.first_, self.second_); }
///
/// and have ByteReader as a friend if they cannot be made empty by others.

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <optional>
#include <span>
#include <stdexcept>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

namespace tetrafront {

namespace detail {

template <class T>
inline constexpr bool kIsOptional = false;
template <class T>
inline constexpr bool kIsOptional<std::optional<T>> = true;
template <class T>
inline constexpr bool kIsVariant = false;
template <class... T>
inline constexpr bool kIsVariant<std::variant<T...>> = true;
template <class T>
inline constexpr bool kIsPlainVector = false;
template <class T>
inline constexpr bool kIsPlainVector<std::vector<T>> = std::is_trivially_copyable_v<T>;

}  // namespace detail

class ByteWriter {
 public:
  /// Appends the values in their order.
  template <class... T>
  void operator()(const T&... values) {
    (write(values), ...);
  }
  [[nodiscard]] std::vector<std::uint8_t> take() { return std::move(bytes_); }

 private:
  template <class T>
  void write(const T& value) {
    if constexpr (detail::kIsOptional<T>) {
      write(value.has_value());
      if (value) write(*value);
    } else if constexpr (detail::kIsVariant<T>) {
      write(static_cast<std::uint32_t>(value.index()));
      std::visit([this](const auto& held) { this->write(held); }, value);
    } else if constexpr (detail::kIsPlainVector<T>) {
      write(value.size());
      append(value.data(), value.size() * sizeof(typename T::value_type));
    } else if constexpr (std::is_trivially_copyable_v<T>) {
      append(&value, sizeof(T));
    } else {
      T::visitMembers(value, *this);
    }
  }
  void append(const void* from, std::size_t count) {
    if (count == 0) return;
    const auto* first = static_cast<const std::uint8_t*>(from);
    bytes_.insert(bytes_.end(), first, first + count);
  }

  std::vector<std::uint8_t> bytes_;
};

/// Reads what a ByteWriter of the same build has written. Throws std::out_of_range if the bytes end before.
class ByteReader {
 public:
  explicit ByteReader(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}

  template <class... T>
  void operator()(T&... values) {
    (read(values), ...);
  }

 private:
  template <class T>
  void read(T& value) {
    if constexpr (detail::kIsOptional<T>) {
      bool isThere = false;
      read(isThere);
      if (isThere) value = readNew<typename T::value_type>();
    } else if constexpr (detail::kIsVariant<T>) {
      std::uint32_t index = 0;
      read(index);
      readVariant(value, index, std::make_index_sequence<std::variant_size_v<T>>{});
    } else if constexpr (detail::kIsPlainVector<T>) {
      std::size_t size = 0;
      read(size);
      // Before memory is asked for: the size may be wrong.
      if (size > bytes_.size() / sizeof(typename T::value_type)) throw ended();
      value.resize(size);
      copy(value.data(), size * sizeof(typename T::value_type));
    } else if constexpr (std::is_trivially_copyable_v<T>) {
      copy(&value, sizeof(T));
    } else {
      T::visitMembers(value, *this);
    }
  }
  template <class T>
  T readNew() {
    T value;
    read(value);
    return value;
  }
  template <class... T, std::size_t... I>
  void readVariant(std::variant<T...>& value, std::uint32_t index,
                   std::index_sequence<I...> /*alternatives*/) {
    const bool isRead = ((index == I && (value = readNew<T>(), true)) || ...);
    if (!isRead) throw ended();
  }
  void copy(void* to, std::size_t count) {
    if (count > bytes_.size()) throw ended();
    if (count > 0) std::memcpy(to, bytes_.data(), count);
    bytes_ = bytes_.subspan(count);
  }
  static std::out_of_range ended() { return std::out_of_range("the bytes of a value are cut"); }

  std::span<const std::uint8_t> bytes_;
};

}  // namespace tetrafront
