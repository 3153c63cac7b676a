#pragma once

#include "bridge/json_messages.h"
#include "experiment/preview.h"

namespace skein::bridge {

/// Answers of /api/preview/formation and /api/preview/path (README.md), but for computed_ms.
Json ToJson(const experiment::Preview& preview);
Json ToJson(const experiment::PathPreview& preview, bool straight_on, bool geometry_only);

}  // namespace skein::bridge
