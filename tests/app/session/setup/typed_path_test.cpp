#include "app/session/setup/typed_path.h"

#include <gtest/gtest.h>

#include "tests/tissue/support/temporary_folder.h"

namespace trocar::typed_path_test {
namespace {

TEST(TypedPath, AFileInAFolderThatIsThereIsFine) {
  test::TemporaryFolder folder;
  for (const std::string& path :
       {std::string("plain.db"), std::string("./plain.db"), std::string(":memory:"), std::string("/"),
        std::string("/x.db"), (folder / "a.db").string(), (folder / "new-folder").string(),
        (folder / "new-folder/").string(), folder.path().string() + "/", (folder / "../x").string()}) {
    EXPECT_EQ(typed_path_fault(path), "") << path;
  }
}

TEST(TypedPath, AMissingFolderIsNamed) {
  test::TemporaryFolder folder;
  const std::string file = (folder / "typo/a.db").string();
  EXPECT_EQ(typed_path_fault(file), file + ": there is no folder " + (folder / "typo").string() + "; make it first");
  EXPECT_NE(typed_path_fault((folder / "typo/deep/").string()).find("no folder " + (folder / "typo").string() + ";"),
            std::string::npos);
  EXPECT_EQ(typed_path_fault(""), "is empty: a file is asked for");
}

TEST(TypedPath, WhatIsInTheWayIsForWhoeverWrites) {
  test::TemporaryFolder folder;
  folder.write("file", "x");
  EXPECT_EQ(typed_path_fault((folder / "file/a.db").string()), "");
}

}  // namespace
}  // namespace trocar::typed_path_test
