// JSON that knows where in a message it is: the first value that cannot be said is refused by its
// place.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "drover/result.h"
#include "json/json_text.h"
#include "ros2/read_scene.h"

namespace drover::ros2 {

class SceneText final {
 public:
  template <class Write>
  void object(Write write) {
    out_.open('{');
    write();
    out_.close('}');
  }
  /// What is looked at and not written.
  template <class Look>
  void pathed(std::string_view name, Look look) {
    const auto before = path_.size();
    if (!path_.empty()) path_ += '.';
    path_ += name;
    look();
    path_.resize(before);
  }
  template <class Write>
  void member(std::string_view name, Write write) {
    out_.key(name);
    pathed(name, write);
  }
  template <class Write>
  void object(std::string_view name, Write write) {
    member(name, [&] { object(write); });
  }
  /// `write(i)` for each.
  template <class Write>
  void list(std::string_view name, std::size_t count, Write write) {
    member(name, [&] {
      out_.open('[');
      const auto before = path_.size();
      for (std::size_t i = 0; i < count; ++i) {
        path_ += "[" + std::to_string(i) + "]";
        write(i);
        path_.resize(before);
      }
      out_.close(']');
    });
  }
  void number(double value);
  void number(std::string_view name, double value) {
    member(name, [&] { number(value); });
  }
  void integer(std::int64_t value) { out_.integer(value); }
  void integer(std::string_view name, std::int64_t value) { out_.key(name).integer(value); }
  void text(std::string_view name, const char* value);

  /// Of where it is now, or of `name` there; the first one counts.
  void refuse(std::string why, std::string_view name = {});
  Result<std::string, SceneRefusal> take();

 private:
  json::JsonText out_;
  std::string path_;
  std::optional<SceneRefusal> refusal_;
};

}  // namespace drover::ros2
