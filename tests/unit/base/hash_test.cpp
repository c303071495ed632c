#include "base/hash.h"

#include "folder_test.h"

namespace vsgl {
namespace {

std::string sha256_text(const std::string& text) {
  return sha256(std::as_bytes(std::span(text)));
}

// FIPS 180-4, examples of appendix B of its first edition.
TEST(Hash, MatchesPublishedVectors) {
  EXPECT_EQ(sha256_text(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  EXPECT_EQ(sha256_text("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  EXPECT_EQ(sha256_text("abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq"),
            "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1");
  EXPECT_EQ(sha256_text(std::string(1000000, 'a')),
            "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
}

using HashFile = test::FolderTest;

TEST_F(HashFile, EqualsTheHashOfTheBytes) {
  const std::string text(200001, 'x');  // more than one block
  write("data", text);
  EXPECT_EQ(sha256_file(path("data")), sha256_text(text));
  write("empty", "");
  EXPECT_EQ(sha256_file(path("empty")), sha256_text(""));
}

TEST_F(HashFile, NamesTheMissingFile) {
  test::expect_error(ErrorCode::file_not_found, "none.exr", [&] { sha256_file(path("none.exr")); });
}

TEST_F(HashFile, RefusesAFolder) {
  test::expect_error(ErrorCode::read_failed, "reading failed", [&] { sha256_file(path("")); });
}

}  // namespace
}  // namespace vsgl
