// The `feedback` topic: which word tells what, and the message around it.
#include "publish/rtk_navigation/feedback.h"

#include "json/json_text.h"

namespace drover::publish {

std::string_view verb_name(Verb verb) {
  constexpr std::string_view kNames[] = {"get_all_trajectory",
                                         "save_trajectory",
                                         "delete_trajectory",
                                         "delete_all_trajectory",
                                         "start_task",
                                         "cancel_task",
                                         "init_rtk_data",
                                         "start_nav",
                                         "reset_stop",
                                         "terminate",
                                         "find_heading",
                                         "release",
                                         "hold",
                                         "accept_position",
                                         "forget_learned"};
  return kNames[static_cast<std::size_t>(verb)];
}

std::string success_cmd(Verb verb) {
  return std::string(verb_name(verb)) + "_success";
}

std::string failure_cmd(Verb verb) {
  return std::string(verb_name(verb)) + "_failse";
}

std::string feedback_text(std::string_view cmd, std::string_view reason, std::string_view note) {
  json::JsonText out;
  out.open('{').key("cmd").text(cmd).key("cmd_type").text("feedback");
  if (!reason.empty()) out.key("reason").text(reason);
  if (!note.empty()) out.key("note").text(note);
  return out.close('}').str();
}

}  // namespace drover::publish
