// A part of the scene on its way to the disk: its text is made once, by who writes it down.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <utility>

namespace drover::store {

/// Who knows the scene makes one with each change, and hands it to the storage thread, which alone
/// asks for the text: a large one takes longer than anybody else may.
class LazyText final {
 public:
  explicit LazyText(std::function<std::string()> make) : make_(std::move(make)) {}
  explicit LazyText(std::string text) : text_(std::move(text)) {}

  const std::string& get() {
    if (make_) text_ = std::exchange(make_, nullptr)();
    return text_;
  }

 private:
  std::function<std::string()> make_;  ///< empty once it was asked
  std::string text_;
};

/// Of an object or a set of constraints; copies share the text.
struct SceneText {
  std::string kind;      ///< kObjectKind or kConstraintKind
  std::string name;      ///< UTF-8
  double arrived_s = 0;  ///< wall time since the epoch
  std::shared_ptr<LazyText> text;
};

}  // namespace drover::store
