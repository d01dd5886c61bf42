#pragma once

/// @file Reads the fields of structs and the names of enumerators at compile time, so that the border between C++ and
/// JavaScript needs no lists of them.
///
/// C++20 has no reflection. Three properties of the language and one of clang replace it:
/// - a struct without constructors can be initialized from as many values as it has fields, but no more;
/// - structured bindings give a reference to each field;
/// - the address of a field of a global variable can be a template argument;
/// - __PRETTY_FUNCTION__ spells template arguments as they are written: `&kSample.record.size`, `Phase::kCheck`.
/// Only clang compiles this directory; the static assertions at the end fail if another compiler spells differently.

#include <algorithm>
#include <array>
#include <cstddef>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <utility>

namespace tetrafront::border {

namespace detail {

/// Converts to every type, to find out how many values initialize a struct.
struct AnyValue {
  template <class T>
  operator T() const;
};

template <class T, std::size_t... I>
consteval bool isInitializable(std::index_sequence<I...>) {
  return requires { T{(static_cast<void>(I), AnyValue{})...}; };
}

inline constexpr std::size_t kMaxFields = 24;

/// Returns the largest number of values that initialize a T.
template <class T, std::size_t N = kMaxFields + 1>
consteval std::size_t countFields() {
  if constexpr (N == 0 || isInitializable<T>(std::make_index_sequence<N>{})) {
    return N;
  } else {
    return countFields<T, N - 1>();
  }
}

/// Storage for a T that is never constructed; only addresses in it are used.
template <class T>
union Sample {
  char none;
  T record;
  constexpr Sample() : none() {}
  constexpr ~Sample() {}
};

template <class T>
inline Sample<T> kSample;

/// Returns the text of a template argument, as clang spells it.
template <auto Value>
consteval std::string_view spelled() {
  std::string_view text = __PRETTY_FUNCTION__;
  text.remove_prefix(text.find("Value = ") + std::string_view("Value = ").size());
  text.remove_suffix(1);
  return text;
}

/// Returns the part of a qualified name after the last separator.
consteval std::string_view lastPart(std::string_view name, std::string_view separator) {
  const std::size_t found = name.rfind(separator);
  return found == std::string_view::npos ? name : name.substr(found + separator.size());
}

}  // namespace detail

/// A struct whose fields can be read: it has neither constructors nor private members.
template <class T>
concept Record = std::is_class_v<T> && std::is_aggregate_v<T>;

template <Record T>
inline constexpr std::size_t kFieldCount = detail::countFields<T>();

/// Returns references to all fields, in their order.
template <class T>
[[nodiscard]] constexpr auto fieldsOf(T& record) {
  static_assert(kFieldCount<T> >= 1 && kFieldCount<T> <= detail::kMaxFields,
                "add a line for structs with more fields");
  if constexpr (kFieldCount<T> == 1) {
    auto& [a] = record;
    return std::tie(a);
  } else if constexpr (kFieldCount<T> == 2) {
    auto& [a, b] = record;
    return std::tie(a, b);
  } else if constexpr (kFieldCount<T> == 3) {
    auto& [a, b, c] = record;
    return std::tie(a, b, c);
  } else if constexpr (kFieldCount<T> == 4) {
    auto& [a, b, c, d] = record;
    return std::tie(a, b, c, d);
  } else if constexpr (kFieldCount<T> == 5) {
    auto& [a, b, c, d, e] = record;
    return std::tie(a, b, c, d, e);
  } else if constexpr (kFieldCount<T> == 6) {
    auto& [a, b, c, d, e, f] = record;
    return std::tie(a, b, c, d, e, f);
  } else if constexpr (kFieldCount<T> == 7) {
    auto& [a, b, c, d, e, f, g] = record;
    return std::tie(a, b, c, d, e, f, g);
  } else if constexpr (kFieldCount<T> == 8) {
    auto& [a, b, c, d, e, f, g, h] = record;
    return std::tie(a, b, c, d, e, f, g, h);
  } else if constexpr (kFieldCount<T> == 9) {
    auto& [a, b, c, d, e, f, g, h, i] = record;
    return std::tie(a, b, c, d, e, f, g, h, i);
  } else if constexpr (kFieldCount<T> == 10) {
    auto& [a, b, c, d, e, f, g, h, i, j] = record;
    return std::tie(a, b, c, d, e, f, g, h, i, j);
  } else if constexpr (kFieldCount<T> == 11) {
    auto& [a, b, c, d, e, f, g, h, i, j, k] = record;
    return std::tie(a, b, c, d, e, f, g, h, i, j, k);
  } else if constexpr (kFieldCount<T> == 12) {
    auto& [a, b, c, d, e, f, g, h, i, j, k, l] = record;
    return std::tie(a, b, c, d, e, f, g, h, i, j, k, l);
  } else if constexpr (kFieldCount<T> == 13) {
    auto& [a, b, c, d, e, f, g, h, i, j, k, l, m] = record;
    return std::tie(a, b, c, d, e, f, g, h, i, j, k, l, m);
  } else if constexpr (kFieldCount<T> == 14) {
    auto& [a, b, c, d, e, f, g, h, i, j, k, l, m, n] = record;
    return std::tie(a, b, c, d, e, f, g, h, i, j, k, l, m, n);
  } else if constexpr (kFieldCount<T> == 15) {
    auto& [a, b, c, d, e, f, g, h, i, j, k, l, m, n, o] = record;
    return std::tie(a, b, c, d, e, f, g, h, i, j, k, l, m, n, o);
  } else if constexpr (kFieldCount<T> == 16) {
    auto& [a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p] = record;
    return std::tie(a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p);
  } else if constexpr (kFieldCount<T> == 17) {
    auto& [a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q] = record;
    return std::tie(a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q);
  } else if constexpr (kFieldCount<T> == 18) {
    auto& [a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r] = record;
    return std::tie(a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r);
  } else if constexpr (kFieldCount<T> == 19) {
    auto& [a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s] = record;
    return std::tie(a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s);
  } else if constexpr (kFieldCount<T> == 20) {
    auto& [a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s, t] = record;
    return std::tie(a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s, t);
  } else if constexpr (kFieldCount<T> == 21) {
    auto& [a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s, t, u] = record;
    return std::tie(a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s, t, u);
  } else if constexpr (kFieldCount<T> == 22) {
    auto& [a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s, t, u, v] = record;
    return std::tie(a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s, t, u, v);
  } else if constexpr (kFieldCount<T> == 23) {
    auto& [a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s, t, u, v, w] = record;
    return std::tie(a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s, t, u, v, w);
  } else if constexpr (kFieldCount<T> == 24) {
    auto& [a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s, t, u, v, w, x] = record;
    return std::tie(a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s, t, u, v, w, x);
  }
}

/// Type of field I.
template <Record T, std::size_t I>
using FieldType =
    std::remove_cvref_t<std::tuple_element_t<I, decltype(fieldsOf(std::declval<T&>()))>>;

/// Returns the name of field I.
template <Record T, std::size_t I>
[[nodiscard]] consteval std::string_view fieldName() {
  return detail::lastPart(detail::spelled<&std::get<I>(fieldsOf(detail::kSample<T>.record))>(),
                          ".");
}

/// Returns the distance of field I from the beginning of the struct, in bytes.
template <Record T, std::size_t I>
[[nodiscard]] std::size_t fieldOffset() {
  const T& record = detail::kSample<T>.record;
  return static_cast<std::size_t>(
      reinterpret_cast<const std::byte*>(&std::get<I>(fieldsOf(record))) -
      reinterpret_cast<const std::byte*>(&record));
}

/// Returns the text, followed by 0.
template <std::size_t Size>
[[nodiscard]] consteval std::array<char, Size + 1> terminated(std::string_view text) {
  std::array<char, Size + 1> result{};
  std::copy(text.begin(), text.end(), result.begin());
  return result;
}

/// The name of field I, followed by 0.
template <Record T, std::size_t I>
inline constexpr auto kFieldName = terminated<fieldName<T, I>().size()>(fieldName<T, I>());

/// Calls `visit` with an std::integral_constant for the index of each field.
template <Record T, class Visit>
constexpr void forEachField(const Visit& visit) {
  [&]<std::size_t... I>(std::index_sequence<I...>) {
    (visit(std::integral_constant<std::size_t, I>{}), ...);
  }(std::make_index_sequence<kFieldCount<T>>{});
}

/// Returns the name of an enumerator; empty if no enumerator has this value.
template <auto Value>
  requires std::is_enum_v<decltype(Value)>
[[nodiscard]] consteval std::string_view enumeratorName() {
  // A value without an enumerator is spelled as a cast: `(Phase)9`.
  if (detail::spelled<Value>().starts_with('(')) return {};
  return detail::lastPart(detail::spelled<Value>(), "::");
}

namespace detail {

struct Probe {
  double first = 0.0;
  bool second = false;
};
enum class ProbeKind { kSecond = 1 };

static_assert(kFieldCount<Probe> == 2);
static_assert(fieldName<Probe, 1>() == "second");
static_assert(enumeratorName<ProbeKind::kSecond>() == "kSecond");
static_assert(enumeratorName<ProbeKind{0}>().empty());

}  // namespace detail

}  // namespace tetrafront::border
