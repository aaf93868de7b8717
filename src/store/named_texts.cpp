// Texts that the store does not understand, by kind and name, in one durable file.
#include "store/named_texts.h"

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <set>
#include <utility>

#include "json/json_text.h"
#include "json/located_json.h"

namespace drover::store {
namespace {

constexpr int kVersion = 1;

/// A text stands as it is after a line that says what it is and how long.
struct Head {
  std::string kind;
  std::string name;
  double arrived_s = 0;
  std::size_t bytes = 0;
};

std::string head_line(const NamedText& text) {
  json::JsonText out;
  out.open('{').key("kind").text(text.kind).key("name").text(text.name);
  out.key("arrived_s").number(text.arrived_s + 0.0);
  out.key("bytes").integer(static_cast<std::int64_t>(text.text.size())).close('}').newline();
  return out.take();
}

std::optional<Head> read_head(std::string_view line) {
  const auto parsed = json::parse(line);
  if (!parsed.ok()) return std::nullopt;
  const auto* kind = parsed->root.find("kind");
  const auto* name = parsed->root.find("name");
  const auto* arrived = parsed->root.find("arrived_s");
  const auto* bytes = parsed->root.find("bytes");
  if (kind == nullptr || kind->text() == nullptr || name == nullptr || name->text() == nullptr ||
      arrived == nullptr || !arrived->number() || bytes == nullptr || !bytes->integer() ||
      *bytes->integer() < 0)
    return std::nullopt;
  return Head{*kind->text(), *name->text(), *arrived->number(),
              static_cast<std::size_t>(*bytes->integer())};
}

bool reads_back(const NamedText& text) {
  const auto head = read_head(head_line(text));
  return head && head->kind == text.kind && head->name == text.name &&
         head->arrived_s == text.arrived_s;
}

std::string shown_name(const NamedText& text) {
  return text.kind + " " + json::shown(text.name, 60);
}

Failure too_large(const NamedTextsFile& file) {
  return Failure{"all together have more than " + std::to_string(file.max_bytes) +
                 " bytes; delete some"};
}

}  // namespace

Result<std::string, Failure> encode_named_texts(const NamedTextsFile& file,
                                                const std::vector<NamedText>& texts) {
  if (texts.size() > file.max_texts) {
    return Failure{std::to_string(texts.size()) + " are more than " +
                   std::to_string(file.max_texts)};
  }
  std::string body;
  std::set<std::pair<std::string_view, std::string_view>> seen;
  for (const NamedText& text : texts) {
    if (!seen.emplace(text.kind, text.name).second)
      return Failure{shown_name(text) + " is there twice"};
    if (!reads_back(text)) return Failure{shown_name(text) + ": its name is no UTF-8, or no time"};
    if (text.text.size() > file.max_bytes) return too_large(file);
    body += head_line(text) + text.text + '\n';
    if (body.size() > file.max_bytes) return too_large(file);
  }
  std::string content = seal(file.format, kVersion, body);
  if (content.size() > file.max_bytes) return too_large(file);
  return content;
}

Result<std::vector<NamedText>, Failure> decode_named_texts(const NamedTextsFile& file,
                                                           std::string_view content) {
  const auto body = unseal(file.format, kVersion, content);
  if (!body.ok()) return body.error();
  std::vector<NamedText> texts;
  std::string_view rest = *body;
  while (!rest.empty()) {
    const auto line_end = rest.find('\n');
    const auto head = read_head(rest.substr(0, line_end));
    const Failure broken{"tells nothing of text " + std::to_string(texts.size() + 1)};
    if (line_end == rest.npos || !head) return broken;
    rest.remove_prefix(line_end + 1);
    if (head->bytes >= rest.size() || rest[head->bytes] != '\n') return broken;
    texts.push_back(
        {head->kind, head->name, head->arrived_s, std::string(rest.substr(0, head->bytes))});
    rest.remove_prefix(head->bytes + 1);
  }
  return texts;
}

LoadedTexts load_named_texts(Files& files, const std::string& folder, const NamedTextsFile& file) {
  const std::string path = folder + "/" + std::string(file.file);
  std::string content;
  const int error = files.read(path, file.max_bytes, content);
  if (error == ENOENT) return {};
  if (is_foreign(error)) {
    return {.problem = foreign_text(folder, std::string(file.file)),
            .is_there = true,
            .is_foreign = true};
  }
  if (error != 0) {
    const bool for_ever = error == EFBIG || error == EINVAL || error == ELOOP;
    return {.problem = failure_text("read", path, error), .is_there = true, .is_damaged = for_ever};
  }
  auto texts = decode_named_texts(file, content);
  if (!texts.ok())
    return {.problem = path + " " + texts.error().text, .is_there = true, .is_damaged = true};
  return {.problem = "", .is_there = true, .texts = std::move(texts.value())};
}

std::optional<Failure> save_named_texts(Files& files, const std::string& folder,
                                        const NamedTextsFile& file,
                                        const std::vector<NamedText>& texts) {
  const auto content = encode_named_texts(file, texts);
  if (!content.ok()) return content.error();
  return write_durably(files, folder, std::string(file.file), *content);
}

void remove_leftovers(Files& files, const std::string& folder, const NamedTextsFile& file) {
  std::vector<std::string> names;
  if (files.list(folder, names) != 0) return;
  const std::string begin = std::string(file.file) + ".";
  for (const std::string& name : names) {
    if (name.starts_with(begin) && name.ends_with(kTemporaryEnding))
      files.remove(folder + "/" + name);
  }
}

}  // namespace drover::store
