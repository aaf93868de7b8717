// Who stands between a person's terminal and this program, on this computer. Pure.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace drover::cli {

struct TerminalSigns {
  /// The programs that this one runs within, as /proc/PID/stat names them: at most 15 letters.
  std::vector<std::string> ancestors;
  std::string_view tmux;    ///< TMUX; empty: not set
  std::string_view screen;  ///< STY
};

/// The program on this computer that may answer for the person's terminal, or go on when that is
/// gone; empty: none is known of. What runs at the person's own end is no ancestor, and does no
/// harm.
inline std::string stands_between(const TerminalSigns& signs) {
  for (const std::string& name : signs.ancestors) {
    if (name.starts_with("tmux")) return "tmux";  // "tmux: server"
    if (name == "SCREEN") return "screen";
    for (const char* known :
         {"screen", "mosh-server", "zellij", "dtach", "abduco", "shpool", "dvtm", "byobu", "ttyd",
          "gotty", "wetty", "shellinaboxd", "xrdp-sesman", "vim", "nvim", "emacs"})
      if (name == known) return known;
  }
  if (!signs.tmux.empty()) return "tmux";
  return signs.screen.empty() ? "" : "screen";
}

}  // namespace drover::cli
