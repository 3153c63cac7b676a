#pragma once

#include <filesystem>
#include <skein/formation_t.hpp>
#include <string>

/// Formations as JSON, with the names of a scenario's formations (cpp/config/README.md). "leader" and "path"
/// are left aside: the leader goes on from where it is, and a path is uploaded by itself.
namespace skein::cli {

/// Throws config::ConfigError with file, place and reason.
formation_t ReadFormationFile(const std::filesystem::path& file);

/// One that ReadFormationFile takes back.
std::string WriteFormation(const formation_t& formation);

}  // namespace skein::cli
