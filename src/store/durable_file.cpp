// Small files that are either wholly there or not at all, and that tell when they were damaged.
#include "store/durable_file.h"

#include <algorithm>
#include <cerrno>
#include <cinttypes>
#include <cstdio>
#include <system_error>

#include "json/json_text.h"
#include "json/located_json.h"

namespace drover::store {
namespace {

constexpr std::string_view kFooter = "\n}\n";
constexpr const char* kAsideEnding = ".bad";

std::string header(std::string_view format, int version, std::uint64_t sum) {
  char digits[17] = {};
  std::snprintf(digits, sizeof digits, "%016" PRIx64, sum);
  json::JsonText out;
  out.open('{').key("format").text(format).key("version").integer(version);
  out.key("checksum").text(digits).key("body").newline();
  return out.take();
}

/// A name nobody uses: a second save must not meet the leavings of one that failed.
int create_temporary(Files& files, const std::string& path, std::string& temporary, int& fd) {
  int error = EEXIST;
  for (int i = 0; i < 100 && error == EEXIST; ++i) {
    temporary = path + "." + std::to_string(i) + std::string(kTemporaryEnding);
    error = files.create(temporary, fd);
  }
  return error;
}

}  // namespace

std::uint64_t fingerprint(std::string_view text) {
  std::uint64_t sum = 0xcbf29ce484222325ULL;
  for (const char c : text) {
    sum ^= static_cast<unsigned char>(c);
    sum *= 0x100000001b3ULL;
  }
  return sum;
}

std::string seal(std::string_view format, int version, std::string_view body) {
  std::string text = header(format, version, fingerprint(body));
  text += body;
  text += kFooter;
  return text;
}

Result<std::string_view, Failure> unseal_front(std::string_view format, int version,
                                               std::string_view text) {
  if (text.empty()) return Failure{"is empty"};
  const auto break_at = text.find('\n');
  const std::string front(text.substr(0, break_at));
  const auto head = json::parse(front + "0}");
  if (break_at == text.npos || !head.ok()) return Failure{"does not begin like a stored file"};
  const auto* kind = head->root.find("format");
  const auto* number = head->root.find("version");
  if (kind == nullptr || kind->text() == nullptr || *kind->text() != format) {
    return Failure{"is no " + std::string(format)};
  }
  if (number == nullptr || number->integer() != version) {
    return Failure{"is of another version of the format"};
  }
  return text.substr(break_at + 1);
}

Result<std::string, Failure> unseal(std::string_view format, int version, std::string_view text) {
  const auto rest = unseal_front(format, version, text);
  if (!rest.ok()) return rest.error();
  if (!rest->ends_with(kFooter)) return Failure{"is cut short"};
  std::string body(rest->substr(0, rest->size() - kFooter.size()));
  const auto front = text.substr(0, text.size() - rest->size());
  if (front != header(format, version, fingerprint(body))) {
    return Failure{"is damaged: its checksum differs"};
  }
  return body;
}

std::string failure_text(std::string_view step, const std::string& path, int error) {
  return "cannot " + std::string(step) + " " + path + ": " + std::generic_category().message(error);
}

std::optional<Failure> write_durably(Files& files, const std::string& folder,
                                     const std::string& name, std::string_view content) {
  const std::string path = folder + "/" + name;
  std::string temporary;
  int descriptor = -1;
  if (const int e = create_temporary(files, path, temporary, descriptor); e != 0) {
    return Failure{failure_text("create", temporary, e)};
  }
  std::string_view step = "write";
  int error = files.write(descriptor, content);
  if (error == 0) {
    step = "sync";
    error = files.sync(descriptor);
  }
  if (const int e = files.close(descriptor); error == 0 && e != 0) {
    step = "close";
    error = e;
  }
  if (error == 0) {
    step = "rename";
    error = files.rename(temporary, path);
  }
  if (error != 0) {
    files.remove(temporary);
    return Failure{failure_text(step, temporary, error)};
  }
  if (const int e = files.sync_folder(folder); e != 0)
    return Failure{failure_text("sync", folder, e)};
  return std::nullopt;
}

bool is_foreign(int error) {
  return error == EACCES || error == EPERM;
}

std::string foreign_text(const std::string& folder, const std::string& name) {
  return folder + "/" + name + " belongs to another user: sudo chown -R drover: " + folder +
         " and sudo systemctl restart droverd";
}

Result<std::string, Failure> quarantine(Files& files, const std::string& folder,
                                        const std::string& name) {
  std::vector<std::string> taken;
  if (const int e = files.list(folder, taken); e != 0)
    return Failure{failure_text("list", folder, e)};
  std::string aside = name + kAsideEnding;
  for (int i = 2; std::find(taken.begin(), taken.end(), aside) != taken.end(); ++i) {
    aside = name + kAsideEnding + std::to_string(i);
  }
  if (const int e = files.rename(folder + "/" + name, folder + "/" + aside); e != 0) {
    return Failure{failure_text("rename", folder + "/" + name, e)};
  }
  return aside;
}

std::string put_aside(Files& files, const std::string& folder, const std::string& name) {
  const auto aside = quarantine(files, folder, name);
  return aside.ok() ? "kept as " + *aside : aside.error().text;
}

bool lies_aside(Files& files, const std::string& folder, const std::string& name) {
  std::vector<std::string> names;
  if (files.list(folder, names) != 0) return false;
  return std::any_of(names.begin(), names.end(), [&](const std::string& each) {
    return each.starts_with(name + kAsideEnding);
  });
}

}  // namespace drover::store
