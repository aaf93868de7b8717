// A task's report as JSON, without line breaks: what `drover report --json` prints.
#pragma once

#include <string>

#include "publish/report/task_report.h"
#include "store/report_store.h"

namespace drover::publish {

/// The figures and the pauses; and the track with the way that was driven. Absent values are null.
store::ReportTexts report_texts(const TaskReport& report);

}  // namespace drover::publish
