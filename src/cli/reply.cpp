#include "cli/reply.h"

#include <cstdio>

#include "cli/client.h"
#include "cli/exit_codes.h"
#include "cli/layout.h"
#include "json/json_text.h"

namespace drover::cli {

Reply read_reply(std::string text) {
  // Numbers of tracks are as they came.
  auto document = json::parse(text, {.max_bytes = std::size_t{64} << 20,
                                     .max_depth = 16,
                                     .max_values = 10'000'000,
                                     .long_integers = true});
  if (!document) throw NoAnswer{"the answer is not understood: " + document.error().text()};
  Reply answer;
  answer.text = std::move(text);
  answer.document = std::move(document.value());
  const auto& root = answer.document.root;
  answer.done = yes(at(root, "ok"));
  answer.reason =
      at(root, "reason").text() != nullptr ? cli::text(at(root, "reason")) : "no reason";
  answer.note = cli::text(at(root, "note"));
  return answer;
}

int tell(const Reply& answer, bool json, const Show& show) {
  const int code = answer.done ? kDone : kRefused;
  if (json) {
    std::printf("%s\n", answer.text.c_str());
  } else if (!answer.done) {
    std::fprintf(stderr, "refused: %s\n", answer.reason.c_str());
  } else if (show) {
    std::fputs(show(answer.document.root).c_str(), stdout);
  } else {
    std::printf("done%s%s\n", answer.note.empty() ? "" : ": ", answer.note.c_str());
  }
  return code;
}

int tell_member(const Reply& answer, bool json, std::string_view wanted, const Show& show) {
  const auto* member = answer.document.root.find(wanted);
  if (!show || member == nullptr) return tell(answer, json);
  return tell(answer, json, [&](const json::Node&) { return show(*member); });
}

std::string request(std::string_view cmd) {
  return json::JsonText().open('{').key("cmd").text(cmd).close('}').take();
}

std::string named_request(std::string_view cmd, const std::string& name) {
  return json::JsonText().open('{').key("cmd").text(cmd).key("name").text(name).close('}').take();
}

}  // namespace drover::cli
