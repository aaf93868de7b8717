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
#include "cli/show_replay.h"
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

int play(const Settings& settings) {
  const MappedFile file(settings.file);
  auto it = file.problem().empty() ? gateway::replay(file.bytes()) : Replayed{};
  if (!file.problem().empty()) it.note = file.problem();
  if (settings.json) {
    std::printf("%s\n", replay_json(it).c_str());
  } else if (it.verdict == Replayed::Verdict::unusable) {
    std::fprintf(stderr, "drover: %s: %s\n", settings.file.c_str(), it.note.c_str());
  } else {
    std::fputs(show_replay(it).c_str(), stdout);
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
