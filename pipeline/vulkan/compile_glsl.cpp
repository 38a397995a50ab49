#include "pipeline/vulkan/compile_glsl.h"

#include <glslang/Public/ResourceLimits.h>
#include <glslang/Public/ShaderLang.h>
#include <glslang/SPIRV/GlslangToSpv.h>

#include <charconv>
#include <mutex>
#include <sstream>

namespace edgewise::vulkan {
namespace {

constexpr int kVersion = 460;
constexpr auto kMessages = static_cast<EShMessages>(EShMsgSpvRules | EShMsgVulkanRules);

/// glslang's process-wide state, for as long as the program runs.
std::mutex& library() {
    static std::mutex mutex;
    static const struct Process {
        Process() { glslang::InitializeProcess(); }
        ~Process() { glslang::FinalizeProcess(); }
    } process;
    return mutex;
}

void setTarget(glslang::TShader& shader, const char* const& text) {
    shader.setStrings(&text, 1);
    shader.setEnvInput(glslang::EShSourceGlsl, EShLangCompute, glslang::EShClientVulkan, kVersion);
    shader.setEnvClient(glslang::EShClientVulkan, glslang::EShTargetVulkan_1_2);
    shader.setEnvTarget(glslang::EShTargetSpv, glslang::EShTargetSpv_1_5);
}

/// "SOURCE:LINE: WHAT" of a message, or WHAT alone.
GlslError parseMessage(const std::string& message) {
    int source = 0, line = 0;
    const char* const begin = message.data();
    const char* const end = begin + message.size();
    const auto first = std::from_chars(begin, end, source);
    if (first.ec == std::errc() && first.ptr < end && *first.ptr == ':') {
        const auto second = std::from_chars(first.ptr + 1, end, line);
        if (second.ec == std::errc() && second.ptr + 1 < end && *second.ptr == ':')
            return {source, line, std::string(second.ptr + 2, end)};
    }
    return {0, 0, message};
}

[[noreturn]] void fail(const char* log) {
    constexpr std::string_view kMark = "ERROR: ";
    std::istringstream lines(log);
    for (std::string line; std::getline(lines, line);) {
        if (!line.starts_with(kMark)) continue;
        std::string more;  // an indented line goes on
        if (std::getline(lines, more) && more.starts_with(' ')) line += more;
        throw parseMessage(line.substr(kMark.size()));
    }
    throw GlslError(0, 0, "does not compile");
}

}  // namespace

std::vector<std::uint32_t> compileGlsl(const std::string& text) {
    const std::lock_guard lock(library());
    glslang::TShader shader(EShLangCompute);
    const char* const string = text.c_str();
    setTarget(shader, string);
    if (!shader.parse(GetDefaultResources(), kVersion, false, kMessages)) fail(shader.getInfoLog());
    glslang::TProgram program;
    program.addShader(&shader);
    if (!program.link(kMessages)) fail(program.getInfoLog());
    std::vector<std::uint32_t> words;
    glslang::GlslangToSpv(*program.getIntermediate(EShLangCompute), words);
    return words;
}

std::string preprocessGlsl(const std::string& text) {
    const std::lock_guard lock(library());
    glslang::TShader shader(EShLangCompute);
    const char* const string = text.c_str();
    setTarget(shader, string);
    std::string result;
    glslang::TShader::ForbidIncluder none;
    if (!shader.preprocess(GetDefaultResources(), kVersion, ECoreProfile, false, false,
                           static_cast<EShMessages>(kMessages | EShMsgOnlyPreprocessor), &result, none))
        fail(shader.getInfoLog());
    return result;
}

}  // namespace edgewise::vulkan
