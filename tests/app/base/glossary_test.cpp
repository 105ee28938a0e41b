#include "app/base/glossary.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <set>
#include <string>

#include "app/measure/compare_table.h"
#include "tests/support/temporary_folder.h"

namespace worldy {
namespace {

TEST(Glossary, theReadmeHoldsEveryTermWithItsMeaning) {
    const std::string readme = tests::contentOf(WORLDY_SOURCE_DIR "/app/README.md");
    for (const Term& term : glossary) {
        EXPECT_THAT(readme,
                    testing::HasSubstr(fmt::format("| `{}` | {} | {} |", term.key, term.name, term.meaning)));
    }
}

TEST(Glossary, noTwoTermsShareAKeyOrAName) {
    std::set<std::string> keys;
    std::set<std::string> names;
    for (const Term& term : glossary) {
        EXPECT_TRUE(keys.insert(term.key).second) << term.key;
        EXPECT_TRUE(names.insert(term.name).second) << term.name;
    }
}

}  // namespace
}  // namespace worldy
