#include "cli/token_command_line.h"

#include <algorithm>
#include <vector>

#include "access/tokens.h"
#include "cli/text_table.h"

namespace skein::cli {
namespace {

/// "operator-1", or the first such name that nobody has.
std::string FreeName(const std::filesystem::path& file, const std::string& role) {
  std::vector<access::Token> tokens;
  if (std::filesystem::exists(file)) tokens = access::ReadTokens(file);
  for (int number = 1;; ++number) {
    std::string name = role + "-" + std::to_string(number);
    if (std::ranges::none_of(tokens, [&](const auto& token) { return token.name == name; })) return name;
  }
}

}  // namespace

void TokenCommandLine::Add(CLI::App& app, const Choose& choose) {
  CLI::App* group = app.add_subcommand("token", "Who is let in by a web-bridge that demands tokens");
  group->require_subcommand(1);
  file_ = access::DefaultTokensFile();
  const auto add = [&](const char* name, const char* description,
                       int (TokenCommandLine::*run)(std::ostream&) const) {
    CLI::App* command = group->add_subcommand(name, description);
    command->add_option("--file", file_, "Where the hashes of the tokens are kept")->capture_default_str();
    command->callback(
        [this, choose, run] { choose([this, run](std::ostream& out) { return (this->*run)(out); }); });
    return command;
  };
  CLI::App* make =
      add("new", "Make a token and print it, this once: only its hash is kept", &TokenCommandLine::New);
  make->add_option("name", name_,
                   "Whose it is; shown to others who are there (default: operator-1 or the like)");
  make->add_option("--role", role_, "viewer: may only look; operator: may take control and command")
      ->check(CLI::IsMember({"viewer", "operator"}))
      ->capture_default_str();
  add("list", "Who has a token", &TokenCommandLine::List);
  add("revoke", "Take a token away: it opens nothing from now on", &TokenCommandLine::Revoke)
      ->add_option("name", name_, "As `list` names it")
      ->required();
}

int TokenCommandLine::New(std::ostream& out) const {
  const auto role = role_ == "operator" ? access::Role::kOperator : access::Role::kViewer;
  const std::string secret = access::NewToken(file_, name_.empty() ? FreeName(file_, role_) : name_, role);
  out << secret << '\n';
  return 0;
}

int TokenCommandLine::List(std::ostream& out) const {
  Table table = {{"name", "role", "created"}};
  for (const access::Token& token : access::ReadTokens(file_))
    table.push_back({token.name, std::string(access::NameOf(token.role)), token.created});
  out << Aligned(table, table.front().size());
  return 0;
}

int TokenCommandLine::Revoke(std::ostream& out) const {
  access::RevokeToken(file_, name_);
  out << "the token of " << name_ << " opens nothing any more\n";
  return 0;
}

}  // namespace skein::cli
