// What the scene's thread and its parser are asked, and what they answer. Each is a value: no
// thread holds what is another one's. Behind a shared_ptr to const is what several threads keep at
// the same time: zones, paths and stored shapes are megabytes, nobody changes them after they were
// made, and nobody knows which thread lets go of them last.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "drover/path.h"
#include "drover/result.h"
#include "publish/scene/messages.h"
#include "scene/keeper/keeper.h"
#include "scene/plane/point.h"

namespace drover::publish {

using SceneValue = std::variant<scene::CollisionObject, scene::Constraints>;

/// An object or a set of constraints as it is now.
using SceneContent = std::variant<scene::StoredObject, scene::StoredSet>;

// To the scene's thread.

/// In their order; each was found valid by itself.
struct ApplyMessages {
  std::vector<SceneValue> messages;
  scene::Arrived arrived;
};
/// All that there are; `problem`: why they are not known.
struct SetZones {
  std::shared_ptr<const std::vector<scene::Zone>> zones;
  std::string problem;
  bool takes_away = false;  ///< one that was there: not while somebody moves the robot
};
/// Objects and constraints; not while somebody moves the robot.
struct ClearScene {};
/// A person gave up what of the stored scene is lost.
struct AcceptSceneLoss {};
struct ListScene {};
struct ShowScene {
  std::string name;
};
/// Before a task is started; the path is kept, to look along it when it is driven.
struct CheckTrack {
  std::shared_ptr<const Path> path;
  std::uint32_t target = 0;
};

struct SceneJob {
  std::uint64_t number = 0;  ///< comes back with the reply
  std::variant<ApplyMessages, SetZones, ClearScene, AcceptSceneLoss, ListScene, ShowScene,
               CheckTrack>
      what;
};

// From the scene's thread.

/// What of an object or a set is to be stored from now on.
struct SceneChange {
  std::string_view kind;  ///< store::kObjectKind or kConstraintKind
  std::string name;
  std::shared_ptr<const SceneContent> content;  ///< nullptr: it is gone
};

/// What became of one message.
struct MessageApplied {
  std::optional<scene::Refusal> refusal{};  ///< nothing: it is done
  std::vector<std::string> notes{};         ///< for the answer
};
struct MessagesApplied {
  std::vector<MessageApplied> results;  ///< of each message
  std::vector<SceneChange> changes;
};
/// Of what is only done: zones, clearing, a loss accepted.
struct SceneDone {};
/// Nothing was changed: somebody moves the robot by now.
struct SceneRefused {
  std::string_view why;  ///< of not_while()
};
/// A row of what a person asked to see.
struct SceneRow {
  std::string_view kind;
  std::string name;
  std::size_t shapes = 0;
  std::size_t triangles = 0;
  std::optional<scene::Point2> in_map{};   ///< of the first shape
  std::optional<scene::Point2> nearest{};  ///< Keeper::nearest_of
  std::size_t joint = 0;                   ///< constraints, by kind
  std::size_t position = 0;
  std::size_t orientation = 0;
  std::size_t visibility = 0;
};
struct SceneListed {
  std::vector<SceneRow> rows;
};
struct SceneShown {
  std::shared_ptr<const SceneContent> object;       ///< nullptr: there is none
  std::shared_ptr<const SceneContent> constraints;  ///< likewise
};
struct TrackChecked {
  std::optional<scene::TrackOffence> offence;
};
/// Of a zone that cannot be read only the name is known.
struct UnreadableZone {
  std::string name;
  std::string why;
};
/// Once, before all others, under the number 0.
struct SceneRestored {
  struct Lost {
    std::string kind;
    std::string name;
  };
  std::vector<Lost> lost;  ///< texts that are no part of the scene now
  std::string problem;     ///< in words; empty: all is as it was stored
  std::shared_ptr<const std::vector<scene::Zone>> zones;
  std::vector<UnreadableZone> unreadable;
  std::string zones_problem;  ///< of the file as a whole
};
/// In words; empty: the zones are known.
std::string zones_problem(const std::string& of_file,
                          const std::vector<UnreadableZone>& unreadable);

struct SceneReply {
  std::uint64_t number = 0;
  std::variant<MessagesApplied, SceneDone, SceneRefused, SceneListed, SceneShown, TrackChecked,
               SceneRestored>
      what;
};

// To the scene's parser, for what is too large to be read or written where somebody waits.

struct ParseMessages {
  std::string_view topic;  ///< kTopicCollisionObject or kTopicPlanningConstraints
};
/// Where base_link is, as far as somebody knows it.
struct RobotPlace {
  std::optional<GeodeticPoint> origin;
  std::optional<scene::Point2> in_map;
};
/// The payload is the whole line of the request.
struct ImportZone {
  RobotPlace robot;
};
struct ListZones {
  std::shared_ptr<const std::vector<scene::Zone>> zones;
  std::vector<UnreadableZone> unreadable;
  std::string problem;
  RobotPlace robot;
};
struct WriteShown {
  SceneShown shown;
};

struct SceneTextJob {
  std::uint64_t number = 0;
  std::string payload;
  std::variant<ParseMessages, ImportZone, ListZones, WriteShown> what;
};

using ParsedObjects = Result<SceneMessages<scene::CollisionObject>, scene::Refusal>;
using ParsedConstraints = Result<SceneMessages<scene::Constraints>, scene::Refusal>;
/// A zone that may be stored, when there is room for it.
struct ZoneRead {
  scene::Zone zone;
  std::string text;   ///< for the store
  std::string shown;  ///< as JSON, with its measures
  std::vector<std::string> notes;
};

struct SceneTextReply {
  SceneTextJob job;
  /// A text: the line of a reply. A refusal of a zone: why, in words.
  std::optional<
      std::variant<ParsedObjects, ParsedConstraints, Result<ZoneRead, std::string>, std::string>>
      result;
};

/// Does what the job asks for, and is as slow as that is.
void do_scene_text_job(SceneTextReply& reply);

}  // namespace drover::publish
