// What a person asks of the scene and its zones by a line of the daemon's socket. The requests and
// their answers are in README.md of publish/scene.
//
// Pure, as outlets are. A change of the zones is stored, then it acts, then it is answered; one at
// a time.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "json/located_json.h"
#include "publish/actions.h"
#include "publish/scene_jobs.h"
#include "publish/scene_saver.h"
#include "publish/scene_topics.h"

namespace drover::publish {

/// What a request needs to know of the robot now.
struct RobotNow {
  RobotPlace place;
  /// Who moves it, or is about to: why nothing that was in its way may be taken out of it by a
  /// person (not_while.h). Empty: nobody.
  std::string_view busy{};
  double wall_s = 0;  ///< since the epoch
};

class SceneRequests final {
 public:
  /// A line that is longer than others may be begins with this.
  static constexpr std::string_view kLongLine = R"({"cmd":"zone_import",)";

  SceneRequests(bool configured, JobNumbers& numbers, SceneSaver& saver,
                std::function<RobotNow(Time)> robot);

  /// False: it is another one's request.
  bool on_line(ClientId client, std::string_view line, Time now, Actions& out);
  void on_restored(SceneRestored restored);
  /// False: it is no request's.
  bool on_reply(SceneReply& reply, Time now, Actions& out);
  bool on_text(SceneTextReply& reply, Time now, Actions& out);
  /// Of a change of the zones, or of a loss; the scene's own saves are another's.
  bool on_stored(const store::StorageReply& reply, Actions& out);
  void on_saved(std::uint64_t save, std::string_view failure, Actions& out);
  /// No room for a job: at the parser, at the scene.
  bool on_unparsed(std::uint64_t number, Actions& out);
  bool on_unasked(const SceneJob& job, Actions& out);
  void on_time(Actions& out);

  /// Why nothing is free, of what was stored; empty: all is known.
  std::string problem() const;

 private:
  struct Asked {
    enum class What : std::uint8_t { list, show, clear, accept, import, remove, forget, zones };
    What what = What::list;
    ClientId client = 0;
    std::string cmd;
    std::string name;
    std::uint64_t save = 0;  ///< of clear: not 0 when it waits for that one
  };
  /// A change of the zones on its way.
  struct ZoneChange {
    std::uint64_t number = 0;
    std::shared_ptr<const std::vector<scene::Zone>> zones;  ///< as they are with it
    std::vector<UnreadableZone> unreadable;
    std::string of_file;
    std::string reply;
    /// It takes this one away. When it is to act and somebody moves the robot by then, it is stored
    /// again.
    std::optional<scene::Zone> taken{};
    std::string_view refused{};  ///< that is under way: why
  };
  using What = Asked::What;

  static std::optional<What> what_of(std::string_view cmd);
  std::string refusal(What what, Time now);
  void ask(Asked asked, std::string_view line, Time now, Actions& out);
  void answer(std::uint64_t number, std::string line, Actions& out);
  void refuse(std::uint64_t number, std::string_view why, Actions& out);
  void import(std::uint64_t number, ZoneRead read, Time now, Actions& out);
  void begin(ZoneChange change, decltype(store::StorageJob::what) job, Actions& out);
  void set_zones(Actions& out);
  void on_zones_set(bool done, std::string_view why_not, Time now, Actions& out);
  void end_putting_back(const store::StorageReply& reply, Actions& out);

  bool configured_;
  JobNumbers& numbers_;
  SceneSaver& saver_;
  std::function<RobotNow(Time)> robot_;
  std::map<std::uint64_t, Asked> asked_;
  bool restored_ = false;
  std::string scene_problem_;
  std::shared_ptr<const std::vector<scene::Zone>> zones_;
  std::vector<UnreadableZone> unreadable_;
  std::string of_file_;  ///< why the zones are not known at all
  std::optional<ZoneChange> change_;
  bool to_be_set_ = false;  ///< the scene's thread had no room for the zones
};

}  // namespace drover::publish
