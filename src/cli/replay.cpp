#include "cli/replay.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>

#include <CLI/CLI.hpp>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>

#include "cli/exit_codes.h"
#include "config/json_text.h"
#include "gateway/replay.h"
#include "link/unique_fd.h"

namespace drover::cli {

namespace {

using gateway::Replayed;

struct Settings {
  std::string file;
  bool json = false;
};

/// A file in memory, without being copied there.
class MappedFile final {
 public:
  explicit MappedFile(const std::string& path) {
    const link::UniqueFd fd(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
    struct stat about {};
    if (!fd || ::fstat(fd.get(), &about) != 0) {
      fail(errno);
    } else if (!S_ISREG(about.st_mode)) {
      problem_ = "is no file";
    } else if (about.st_size > 0) {
      size_ = static_cast<std::size_t>(about.st_size);
      at_ = ::mmap(nullptr, size_, PROT_READ, MAP_PRIVATE, fd.get(), 0);
      if (at_ == MAP_FAILED) fail(errno);
    }
  }
  ~MappedFile() {
    if (at_ != MAP_FAILED) ::munmap(at_, size_);
  }
  MappedFile(const MappedFile&) = delete;
  MappedFile& operator=(const MappedFile&) = delete;

  const std::string& problem() const { return problem_; }
  std::span<const std::uint8_t> bytes() const {
    if (at_ == MAP_FAILED) return {};
    return {static_cast<const std::uint8_t*>(at_), size_};
  }

 private:
  void fail(int error) { problem_ = std::string("cannot be read: ") + std::strerror(error); }
  void* at_ = MAP_FAILED;
  std::size_t size_ = 0;
  std::string problem_;
};

constexpr const char* word(Replayed::Verdict verdict) {
  switch (verdict) {
    case Replayed::Verdict::equal: return "equal";
    case Replayed::Verdict::differs: return "differs";
    case Replayed::Verdict::unusable: return "unusable";
  }
  return "unusable";
}

double seconds(const Replayed& it) {
  return it.begin == kNever ? 0 : to_s(it.end - it.begin);
}

std::string json_text(const Replayed& it) {
  json::JsonText out;
  out.open('{').key("verdict").text(word(it.verdict)).key("note").text(it.note);
  out.key("recorded_by").text(it.version).key("seconds").number(seconds(it));
  out.key("inputs").integer(static_cast<std::int64_t>(it.inputs));
  out.key("cycles").integer(static_cast<std::int64_t>(it.cycles));
  out.key("not_compared").open('[');
  for (const auto& name : it.not_compared) out.text(name);
  out.close(']');
  if (it.verdict == Replayed::Verdict::differs) {
    const auto& d = it.difference;
    out.key("difference").open('{').key("what").text(d.what);
    out.key("cycle").integer(static_cast<std::int64_t>(d.cycle));
    out.key("time_s").number(to_s(d.time)).key("since_begin_s").number(to_s(d.time - it.begin));
    out.key("recorded").text(d.recorded).key("replayed").text(d.replayed);
    out.key("more").integer(static_cast<std::int64_t>(d.more)).key("inputs_before").open('[');
    for (const auto& input : d.inputs) out.text(input);
    out.close(']').close('}');
  }
  return out.close('}').take();
}

void print(const Replayed& it) {
  if (it.verdict == Replayed::Verdict::differs) {
    const auto& d = it.difference;
    std::printf("differs in cycle %llu, %.3f s after its begin (at %.9f s): %s\n",
                static_cast<unsigned long long>(d.cycle), to_s(d.time - it.begin), to_s(d.time),
                d.what.c_str());
    std::printf("  recorded  %s\n  replayed  %s\n", d.recorded.c_str(), d.replayed.c_str());
    if (d.more > 0) std::printf("  and %zu more in that cycle\n", d.more);
    std::printf("the last inputs before it:\n");
    for (const auto& input : d.inputs) std::printf("  %s\n", input.c_str());
  } else {
    std::printf("equal: %llu cycles, %llu inputs, %.1f s\n",
                static_cast<unsigned long long>(it.cycles),
                static_cast<unsigned long long>(it.inputs), seconds(it));
    if (!it.note.empty()) std::printf("%s\n", it.note.c_str());
  }
  if (!it.not_compared.empty())
    std::printf("%zu values were not compared, another version recorded (%s)\n",
                it.not_compared.size(), it.not_compared.front().c_str());
}

int play(const Settings& settings) {
  const MappedFile file(settings.file);
  auto it = file.problem().empty() ? gateway::replay(file.bytes()) : Replayed{};
  if (!file.problem().empty()) it.note = file.problem();
  if (settings.json) {
    std::printf("%s\n", json_text(it).c_str());
  } else if (it.verdict == Replayed::Verdict::unusable) {
    std::fprintf(stderr, "drover: %s: %s\n", settings.file.c_str(), it.note.c_str());
  } else {
    print(it);
  }
  switch (it.verdict) {
    case Replayed::Verdict::equal: return kDone;
    case Replayed::Verdict::differs: return kRefused;
    case Replayed::Verdict::unusable: return kUsage;
  }
  return kUsage;
}

}  // namespace

void add_replay_command(CLI::App& app, int& code) {
  auto* command = app.add_subcommand(
      "replay", "play a recording of droverd again and say where this program differs");
  const auto settings = std::make_shared<Settings>();
  command->add_option("file", settings->file, "written by droverd --record")->required();
  command->add_flag("--json", settings->json, "one JSON object");
  command->footer(
      "Exit codes: 0 equal, 1 differs, 2 no usable recording.\n"
      "Examples:\n"
      "  drover replay run.rec\n"
      "  drover replay run.rec --json");
  command->callback([settings, &code] { code = play(*settings); });
}

}  // namespace drover::cli
