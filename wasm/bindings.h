#pragma once

/// @file What the bindings of the package's modules share. Only the bindings use embind. They declare, convert and
/// forward, and contain no logic of their own. No exception leaves them: a call that fails reports the reason in
/// failure() and returns an empty value; without memory for its object, it returns null.

#include <emscripten/bind.h>
#include <emscripten/heap.h>

#include <cstdint>
#include <functional>
#include <memory>
#include <new>
#include <string>
#include <type_traits>
#include <vector>

#include "failure.h"
#include "js_types.h"
#include "js_values.h"

namespace tetrafront::border {

using Doubles = std::vector<double>;
using Indices = std::vector<std::uint32_t>;

/// An object of the engine for JavaScript. Values are converted where exceptions are caught. After a failure, methods
/// return empty values.
template <class Object>
class Guarded {
 public:
  /// Calls `make` for the object.
  template <class Make>
  explicit Guarded(const Make& make) {
    guard_.run([&] { object_ = std::make_unique<Object>(make()); });
  }

  /// Returns the result of `work` with the object, or `otherwise` after a failure.
  template <class Result, class Work>
  Result call(Result otherwise, const Work& work) {
    if (!guard_.hasFailed()) guard_.run([&] { otherwise = work(*object_); });
    return otherwise;
  }

  /// Returns the result of a method of the object as a JavaScript value.
  template <auto kMethod, class... Arguments>
  auto read(Arguments... arguments) {
    using Result =
        std::remove_cvref_t<std::invoke_result_t<decltype(kMethod), Object&, Arguments...>>;
    const val result = call(
        val(), [&](Object& object) { return toJs(std::invoke(kMethod, object, arguments...)); });
    return Js<Result>(guard_.hasFailed() ? toJs(Result{}) : result);
  }

  /// Returns a Failure.
  [[nodiscard]] std::uint32_t failure() const {
    return static_cast<std::uint32_t>(guard_.failure());
  }
  [[nodiscard]] std::string failureMessage() const { return guard_.message(); }

 private:
  std::unique_ptr<Object> object_;
  FailureGuard guard_;
};

/// Advances a tool; after a failure, it counts as finished.
template <class Tool>
bool advanceTool(Guarded<Tool>& tool, std::uint32_t budget) {
  return tool.call(true, [&](Tool& object) { return object.advance(budget); });
}

template <class Tool>
void stopTool(Guarded<Tool>& tool) {
  tool.call(0, [](Tool& object) { return object.stop(), 0; });
}

template <class Tool>
double fractionOf(Guarded<Tool>& tool) {
  return tool.call(1.0, [](Tool& object) { return object.fraction(); });
}

/// Returns a new tool, made from the values of its arguments; call delete() in JavaScript to destroy it.
template <class Tool, class... Arguments>
Guarded<Tool>* makeTool(const Js<Arguments>&... arguments) {
  return new (std::nothrow) Guarded<Tool>([&] { return Tool(arguments.value()...); });
}

/// Registers a tool as a class and the function that makes one.
template <class Tool, class... Arguments>
void registerTool(const char* className, const char* functionName) {
  emscripten::class_<Guarded<Tool>>(className)
      .function("advance", &advanceTool<Tool>)
      .function("fraction", &fractionOf<Tool>)
      .function("stop", &stopTool<Tool>)
      .function("result", &Guarded<Tool>::template read<&Tool::result>)
      .function("failure", &Guarded<Tool>::failure)
      .function("failureMessage", &Guarded<Tool>::failureMessage);
  emscripten::function(functionName, &makeTool<Tool, Arguments...>,
                       emscripten::allow_raw_pointers());
}

/// Registers the TypeScript types of values that cross the border.
template <class... T>
void registerTypes() {
  (emscripten::register_type<Js<T>>(kTypeScriptType<T>.data()), ...);
}

/// Returns the size of the module's heap in bytes; it never shrinks.
inline double memoryBytes() { return static_cast<double>(emscripten_get_heap_size()); }

}  // namespace tetrafront::border
