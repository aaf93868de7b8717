// A report after each task: collected while it is driven, given to the disk when it ends, read back
// for the command line.
#pragma once

#include <map>
#include <optional>

#include "publish/command_service.h"
#include "publish/outlet.h"
#include "publish/report/task_recorder.h"

namespace drover::publish {

class ReportOutlet final : public Outlet {
 public:
  explicit ReportOutlet(const CommandService& service) : service_(service) {}

  Duration period() const override { return std::chrono::milliseconds(100); }
  bool needs_broker() const override { return false; }
  std::vector<OutMessage> on_snapshot(const Snapshot& seen, const Moment& moment,
                                      Actions& out) override;
  void on_event(const Event& event, Actions& out) override;
  bool on_line(ClientId client, std::string_view line, Time now, Actions& out) override;
  /// Of a StorageJob for reports.
  void on_stored(const store::StorageReply& reply, Actions& out);

 private:
  /// Who waits for the disk.
  struct Question {
    ClientId client = 0;
    bool of_list = false;
    bool of_last = false;  ///< whichever that is
  };
  void begin(RequestId id, Time now);
  void end(RequestId id, Time now, bool begun, TaskEnded::How how, std::string_view reason,
           Actions& out);
  bool list_waits() const;
  /// The disk has taken the last task's report, or not.
  void on_saved(const store::StorageReply& reply, Actions& out);
  RequestId next_id() { return {RequestId::Source::internal, ++last_number_}; }

  const CommandService& service_;
  RequestId task_;
  std::optional<TaskRecorder> recorder_;
  Duration wall_minus_monotonic_{};
  std::uint64_t last_number_ = 0;
  std::string lost_;                             ///< why the last report is lost; empty: it is not
  std::map<std::uint64_t, Question> questions_;  ///< by the number of their job
};

}  // namespace drover::publish
