// The origin: stored, proposed, set, lost.
#include <gmock/gmock.h>

#include "tests/unit/publish/command_service_fixture.h"

namespace drover::publish {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

TEST_F(CommandServiceTest, AStoredOriginGoesToTheEngineAtStart) {
  service_ = std::make_unique<CommandService>(
      CommandServiceConfig{},
      store::StoredState{.origin = kOrigin, .report = {"a file was put aside"}});
  service_->begin(now_, actions_);
  EXPECT_EQ(std::get<SetOrigin>(only<Command>().body).origin.latitude_deg, 23.0);
  EXPECT_EQ(only<LogLine>().text, "a file was put aside");
}

TEST_F(CommandServiceTest, ANewOriginIsStoredBeforeItIsUsed) {
  control(example("init_rtk_data"));
  const Command ask = only<Command>();
  EXPECT_TRUE(std::holds_alternative<ProposeOrigin>(ask.body));
  actions_.clear();
  const GeodeticPoint proposed{23.01, 113.0, 10.0};
  event(OriginProposed{ask.id, proposed});
  const auto job = only<store::StorageJob>();
  EXPECT_EQ(std::get<store::SaveOrigin>(job.what).origin.latitude_deg, 23.01);
  EXPECT_TRUE(all<Command>().empty());
  actions_.clear();
  reply(job, true);
  EXPECT_EQ(std::get<SetOrigin>(only<Command>().body).origin.latitude_deg, 23.01);
  EXPECT_EQ(service_->origin()->latitude_deg, 23.0);
  event(CommandAccepted{only<Command>().id, {}});
  EXPECT_THAT(feedback(), ElementsAre("init_rtk_data_success"));
  EXPECT_EQ(service_->origin()->latitude_deg, 23.01);
  EXPECT_EQ(service_->tracks().size(), 2U) << "it deletes nothing";
  // Tracks of the old origin are derived from latitude and longitude now.
  EXPECT_NEAR(service_->find_track("13")->points[0].y_m, -1106.5, 1);
}

TEST_F(CommandServiceTest, AnOriginThatCannotBeProposedStoredOrUsedFails) {
  control(example("init_rtk_data"));
  event(CommandRefused{only<Command>().id, "no RTK fixed position"});
  EXPECT_THAT(feedback(), ElementsAre("init_rtk_data_failse: no RTK fixed position"));

  control(example("init_rtk_data"));
  event(OriginProposed{only<Command>().id, {24, 113, 0}});
  reply(only<store::StorageJob>(), false, "disk full");
  EXPECT_THAT(feedback(), ElementsAre("init_rtk_data_failse: disk full"));

  control(example("init_rtk_data"));
  event(OriginProposed{only<Command>().id, {24, 113, 0}});
  reply(only<store::StorageJob>(), true);
  const auto id = all<Command>().back().id;
  actions_.clear();
  event(CommandRefused{id, "a task runs"});
  const auto back = std::get<store::SaveOrigin>(only<store::StorageJob>().what);
  EXPECT_EQ(back.origin.latitude_deg, 23.0) << "the disk holds what the engine uses";
  EXPECT_THAT(feedback(), ElementsAre("init_rtk_data_failse: a task runs"));
  EXPECT_EQ(service_->origin()->latitude_deg, 23.0);
}

TEST_F(CommandServiceTest, TwoOriginRequestsAtOnceAreOneTooMany) {
  control(example("init_rtk_data"));
  control(example("init_rtk_data"));
  EXPECT_EQ(all<Command>().size(), 1U);
  EXPECT_THAT(feedback(), ElementsAre("init_rtk_data_failse: the origin is being set already"));
}

TEST_F(CommandServiceTest, TheFirstFixedPositionBecomesTheOriginWhenThereIsNone) {
  make({}, {});
  Snapshot snapshot;
  snapshot.gnss.health = SourceState::fresh;
  snapshot.gnss.position.quality = FixQuality::rtk_float;
  service_->on_snapshot(snapshot, now_, actions_);
  EXPECT_TRUE(all<Command>().empty());
  snapshot.gnss.position.quality = FixQuality::rtk_fixed;
  service_->on_snapshot(snapshot, now_, actions_);
  service_->on_snapshot(snapshot, now_, actions_);
  const Command ask = only<Command>();
  EXPECT_TRUE(std::holds_alternative<ProposeOrigin>(ask.body));
  event(CommandRefused{ask.id, "not yet"});
  EXPECT_THAT(feedback(), IsEmpty()) << "nobody asked";
  service_->on_snapshot(snapshot, now_ + from_s(1), actions_);
  EXPECT_TRUE(all<Command>().empty());
  service_->on_snapshot(snapshot, now_ + from_s(6), actions_);
  EXPECT_EQ(all<Command>().size(), 1U);
  make({.automatic_origin = false}, {});
  service_->on_snapshot(snapshot, now_, actions_);
  EXPECT_TRUE(actions_.empty());
}

TEST_F(CommandServiceTest, ALostOriginIsToldAndNotReplacedByTheNextPlace) {
  service_ = std::make_unique<CommandService>(
      CommandServiceConfig{},
      store::StoredState{.tracks = {straight("13")}, .origin_problem = "the origin was damaged"});
  service_->begin(now_, actions_);
  EXPECT_EQ(only<LogLine>().text, "the origin was damaged");
  actions_.clear();
  Snapshot snapshot;
  snapshot.gnss.health = SourceState::fresh;
  snapshot.gnss.position.quality = FixQuality::rtk_fixed;
  service_->on_snapshot(snapshot, now_, actions_);
  EXPECT_TRUE(actions_.empty());
  start();
  EXPECT_THAT(feedback(), ElementsAre("start_task_failse: the origin was damaged"));
  EXPECT_EQ(service_->origin_problem(), "the origin was damaged");

  control(example("init_rtk_data"));
  event(OriginProposed{only<Command>().id, kOrigin});
  reply(only<store::StorageJob>(), true);
  event(CommandAccepted{all<Command>().back().id, {}});
  EXPECT_THAT(feedback(), ElementsAre("init_rtk_data_success"));
  EXPECT_EQ(service_->origin_problem(), "");
  start();
  EXPECT_EQ(all<Command>().size(), 1U);
}

}  // namespace
}  // namespace drover::publish
