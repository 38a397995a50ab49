// The one line a bad glTF is refused with.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "pipeline/error.h"
#include "pipeline/load_gltf.h"
#include "tests/pipeline/tiny_gltf_file.h"

namespace edgewise::test {

/// The message of the InputError, without the file's name; "" if the file loads.
inline std::string problemOf(const std::string& bytes) {
    const TempFolder folder;
    writeFile(folder / "a.gltf", bytes);
    try {
        loadGltf(folder / "a.gltf");
    } catch (const InputError& error) {
        const std::string text = error.what(), file = (folder / "a.gltf").string() + ": ";
        EXPECT_EQ(text.substr(0, file.size()), file);
        EXPECT_EQ(text.find('\n'), std::string::npos);
        return text.substr(std::min(file.size(), text.size()));
    }
    return "";
}

}  // namespace edgewise::test
