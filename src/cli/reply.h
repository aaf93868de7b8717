// What droverd answered, and how it is told: as text for people, or as it came for programs.
#pragma once

#include <functional>
#include <string>
#include <string_view>

#include "json/located_json.h"

namespace drover::cli {

struct Reply {
  std::string text;  ///< as it came, one line
  json::Document document;
  bool done = false;   ///< false: refused
  std::string reason;  ///< of a refusal
  std::string note;    ///< of what was done; may be empty
};

/// Throws NoAnswer when it is not understood.
Reply read_reply(std::string text);

using Show = std::function<std::string(const json::Node&)>;

/// Prints what `show` makes of the answer, or that it is done, or on stderr why it was refused; for
/// programs the answer itself. The exit code.
int tell(const Reply& answer, bool json, const Show& show = nullptr);

/// The same, but `show` makes it of this member of the answer. Without one it is told that it is
/// done.
int tell_member(const Reply& answer, bool json, std::string_view wanted, const Show& show);

/// {"cmd":CMD} and {"cmd":CMD,"name":NAME}.
std::string request(std::string_view cmd);
std::string named_request(std::string_view cmd, const std::string& name);

}  // namespace drover::cli
