// The answer of a factory that opens a link: the link, or a sentence that names what is missing.
#pragma once

#include <cerrno>
#include <cstring>
#include <memory>
#include <string>

namespace drover::link {

template <class T>
struct Opened {
  std::unique_ptr<T> link;
  std::string problem;  ///< for people; empty when `link` is there
};

/// "can0: no such interface" style sentences.
inline std::string problem_text(const std::string& what, const std::string& doing, int error) {
  return what + ": " + doing + ": " + std::strerror(error);
}

}  // namespace drover::link
