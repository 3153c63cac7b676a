#include "access/tokens.h"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <fstream>
#include <iterator>

#include "files/atomic_file.h"

namespace skein::access {
namespace {

namespace fs = std::filesystem;

class TokensTest : public testing::Test {
 protected:
  TokensTest() { fs::create_directories(folder_); }
  ~TokensTest() override { fs::remove_all(folder_); }

  std::string Content() const {
    std::ifstream stream(file_);
    return {std::istreambuf_iterator<char>(stream), {}};
  }
  /// What reading the file is refused with, "" when it is read.
  std::string Problem() const {
    try {
      ReadTokens(file_);
      return "";
    } catch (const AccessError& error) {
      return error.what();
    }
  }
  void Write(const std::string& content) { files::WriteAtomically(file_, content, 0600); }

  fs::path folder_ = fs::temp_directory_path() / ("skein_tokens_" + std::to_string(getpid()));
  fs::path file_ = folder_ / "of_its_own" / "tokens.json";
};

TEST_F(TokensTest, ANewOneIsKnownByItsSecretAndTheSecretIsNotKept) {
  const std::string secret = NewToken(file_, "Ada", Role::kOperator);
  EXPECT_GE(secret.size(), 6u + 43u);
  EXPECT_TRUE(secret.starts_with("skein_"));
  const auto tokens = ReadTokens(file_);
  const Token* found = Find(tokens, secret);
  ASSERT_NE(found, nullptr);
  EXPECT_EQ(found->name, "Ada");
  EXPECT_EQ(found->role, Role::kOperator);
  EXPECT_EQ(found->created.size(), std::string("2026-11-28T03:00:00Z").size());
  EXPECT_EQ(Content().find(secret.substr(6)), std::string::npos);
}

TEST_F(TokensTest, NoOtherSecretOpensAnything) {
  const std::string secret = NewToken(file_, "Ada", Role::kOperator);
  const auto tokens = ReadTokens(file_);
  std::string changed = secret;
  changed.back() = changed.back() == 'A' ? 'B' : 'A';
  for (const std::string& wrong : {std::string(), changed, secret.substr(0, 20), secret + "A",
                                   tokens.front().sha256, std::string(10'000'000, 'x')})
    EXPECT_EQ(Find(tokens, wrong), nullptr);
}

TEST_F(TokensTest, EachIsAnother) {
  EXPECT_NE(NewToken(file_, "Ada", Role::kOperator), NewToken(file_, "Bob", Role::kViewer));
  EXPECT_EQ(ReadTokens(file_).size(), 2u);
  EXPECT_THROW(NewToken(file_, "Ada", Role::kViewer), AccessError);
  EXPECT_EQ(ReadTokens(file_).size(), 2u);
}

TEST_F(TokensTest, ARevokedOneOpensNothing) {
  const std::string ada = NewToken(file_, "Ada", Role::kOperator);
  const std::string bob = NewToken(file_, "Bob", Role::kViewer);
  RevokeToken(file_, "Ada");
  const auto tokens = ReadTokens(file_);
  EXPECT_EQ(Find(tokens, ada), nullptr);
  EXPECT_NE(Find(tokens, bob), nullptr);
  EXPECT_THROW(RevokeToken(file_, "Ada"), AccessError);
}

TEST_F(TokensTest, TheFileIsItsOwnersAlone) {
  NewToken(file_, "Ada", Role::kOperator);
  struct stat status {};
  ASSERT_EQ(stat(file_.c_str(), &status), 0);
  EXPECT_EQ(status.st_mode & 0777, 0600u);
  for (const mode_t mode : {0640, 0604, 0620, 0644}) {
    chmod(file_.c_str(), mode);
    EXPECT_NE(Problem().find("chmod 600 " + file_.string()), std::string::npos) << mode;
    EXPECT_THROW(NewToken(file_, "Bob", Role::kViewer), AccessError) << mode;
  }
}

TEST_F(TokensTest, ThatThereAreNoneIsToldWithWhatToDo) {
  EXPECT_NE(Problem().find("skein token new"), std::string::npos);
}

TEST_F(TokensTest, AFileThatIsNotOneIsRefusedWithThePlace) {
  NewToken(file_, "Ada", Role::kOperator);
  const std::string hash = ReadTokens(file_).front().sha256;
  const auto one = [](const std::string& role, const std::string& sha256) {
    return R"({"tokens": [{"name": "Ada", "role": ")" + role + R"(", "sha256": ")" + sha256 + R"("}]})";
  };
  Write(one("operator", hash));
  EXPECT_EQ(Problem(), "");
  Write(one("admiral", hash));
  EXPECT_NE(Problem().find("/tokens/0/role"), std::string::npos) << Problem();
  Write(one("operator", hash.substr(1)));
  EXPECT_NE(Problem().find("/tokens/0/sha256"), std::string::npos) << Problem();
  Write("{\"tokens\": [");
  EXPECT_NE(Problem().find(file_.string()), std::string::npos) << Problem();
}

}  // namespace
}  // namespace skein::access
