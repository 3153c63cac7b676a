#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <ostream>
#include <string>

namespace skein::cli {

/// The options of `skein token`: who may use a web-bridge. Needs no bus.
class TokenCommandLine {
 public:
  /// Does what was asked for and returns the exit code. Throws access::AccessError.
  using Command = std::function<int(std::ostream& out)>;
  using Choose = std::function<void(Command command)>;

  /// @param choose gets the command that was given. Lives as long as this.
  void Add(CLI::App& app, const Choose& choose);

 private:
  int New(std::ostream& out) const;
  int List(std::ostream& out) const;
  int Revoke(std::ostream& out) const;

  std::string file_;
  std::string name_;
  std::string role_ = "viewer";
};

}  // namespace skein::cli
