#include <fcntl.h>
#include <unistd.h>

#include "link/lines.h"
#include "link/unique_fd.h"

namespace drover::link {

namespace {

class FileLines final : public LineLink {
 public:
  explicit FileLines(std::vector<UniqueFd> files) : files_(std::move(files)) {}

  bool read(std::array<bool, kMaxLines>& levels) override {
    for (std::size_t i = 0; i < files_.size(); ++i) {
      char level = 0;
      const auto n = ::pread(files_[i].get(), &level, 1, 0);
      if (n != 1) {
        error_ = n < 0 ? errno : ENODATA;
        return false;
      }
      levels[i] = level == '1';
    }
    return true;
  }
  std::span<const int> edge_fds() const override { return {}; }
  void drain_edges(std::array<bool, kMaxLines>& /*edged*/) override {}
  int error() const override { return error_; }

 private:
  std::vector<UniqueFd> files_;
  int error_ = 0;
};

}  // namespace

Opened<LineLink> open_file_lines(const LineSettings& settings) {
  Opened<LineLink> opened;
  const auto folder = settings.chip.substr(kFilesPrefix.size());
  std::vector<UniqueFd> files;
  for (const auto& line : settings.lines) {
    const auto path = folder + "/" + line;
    UniqueFd fd(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
    if (!fd) {
      opened.problem = problem_text(path, "cannot open", errno);
      return opened;
    }
    files.push_back(std::move(fd));
  }
  opened.link = std::make_unique<FileLines>(std::move(files));
  return opened;
}

Opened<LineLink> open_lines(const LineSettings& settings) {
  if (settings.lines.size() > kMaxLines) {
    Opened<LineLink> opened;
    opened.problem = settings.chip + ": more than " + std::to_string(kMaxLines) + " lines";
    return opened;
  }
  return settings.chip.starts_with(kFilesPrefix) ? open_file_lines(settings)
                                                 : open_gpio_lines(settings);
}

}  // namespace drover::link
