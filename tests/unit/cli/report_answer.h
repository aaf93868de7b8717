// droverd's answer to `report`, as the tests of its text and of its picture read it.
#pragma once

#include <string>

namespace drover::cli {

inline const std::string kReportAnswer =
    R"({"ok":true,"number":12,"report":{"track":"row <7> & \"co\"","target_id":57,)"
    R"("asked_mps":0.5,"began_unix_s":1772373900.4,"result":"failed",)"
    R"("reason":"an obstacle blocked the way for 120 s","time_s":203.4,"moving_s":80.1,)"
    R"("paused_s":123.0,"way_m":40.21,"left_m":12.5,)"
    R"("cross_track":{"from_way_m":0.4,"rms_m":0.0131,"p95_m":0.025,"max_m":0.041},)"
    R"("speed":{"mean_mps":0.483,"max_mps":0.51},"error_bound":{"max_m":0.31,)"
    R"("max_moving_m":0.052},"quality":[{"quality":"rtk fixed","way_m":39.2,"share":0.975},)"
    R"({"quality":"rtk float","way_m":1.01,"share":0.025}],"pauses":[)"
    R"({"reason":"person <script> is in the way","after_s":20.1,"lasted_s":3.0,"x_m":5,"y_m":1,)"
    R"("way_m":9.5},{"reason":"an obstacle","after_s":80,"lasted_s":120.0,"x_m":20,"y_m":1,)"
    R"("way_m":40.2}],"pauses_left_out":0},"line":{"track":[[0,0],[20,0],[20,10]],)"
    R"("columns":["x_m","y_m","way_m","cross_track_m","speed_mps","error_bound_m","quality"],)"
    R"("driven":[[0,0.01,0,0.01,0.5,0.03,"rtk fixed"],[5,0.01,5,0.01,0.5,0.03,"rtk fixed"],)"
    R"([10,0.15,10,0.15,0.5,0.03,"rtk float"],[15,0.15,15,0.15,0.5,null,"rtk float"]]}})";

}  // namespace drover::cli
