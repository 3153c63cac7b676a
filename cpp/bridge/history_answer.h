#pragma once

#include <string>

#include "bridge/history_query.h"
#include "recording/history.h"

namespace skein::bridge {

/// The binary answer of GET /api/history (README.md): the UAVs in the order asked for. One that is not in a
/// sample has no flags there, and -1 where that means none.
std::string EncodeHistory(const recording::HistorySamples& samples, const HistoryQuery& query,
                          bus::Utime start_utime);

}  // namespace skein::bridge
