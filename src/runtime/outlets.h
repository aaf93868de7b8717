// Which outlets there are, made from the configuration: the one place that names them all.
#pragma once

#include <memory>
#include <vector>

#include "config/config.h"
#include "publish/outlet.h"

namespace drover::runtime {

publish::CommandServiceConfig service_config(const config::DroverConfig& config);

/// `service` outlives them.
std::vector<std::unique_ptr<publish::Outlet>> make_outlets(const config::DroverConfig& config,
                                                           publish::CommandService& service);

}  // namespace drover::runtime
