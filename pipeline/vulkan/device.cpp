#include "pipeline/vulkan/device.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>

namespace edgewise::vulkan {
namespace {

constexpr const char* kValidationLayer = "VK_LAYER_KHRONOS_validation";
constexpr std::uint32_t kApiVersion = VK_API_VERSION_1_2;

bool isSet(const char* variable) {
    const char* value = std::getenv(variable);
    return value && std::strcmp(value, "1") == 0;
}

template <class Properties, class Name>
bool contains(const std::vector<Properties>& all, Name name, const char* wanted) {
    return std::any_of(all.begin(), all.end(),
                       [&](const Properties& p) { return std::strcmp(p.*name, wanted) == 0; });
}

bool hasLayer(const vk::raii::Context& context, const char* wanted) {
    return contains(context.enumerateInstanceLayerProperties(), &vk::LayerProperties::layerName, wanted);
}

vk::raii::Instance makeInstance(const vk::raii::Context& context, bool validated) {
    const vk::ApplicationInfo application("edgewise", 1, "edgewise", 1, kApiVersion);
    std::vector<const char*> layers, extensions;
    if (validated)
        layers.push_back(kValidationLayer), extensions.push_back(VK_EXT_DEBUG_UTILS_EXTENSION_NAME);
    return {context, vk::InstanceCreateInfo({}, &application, layers, extensions)};
}

std::optional<std::uint32_t> queueFamilyOf(const vk::raii::PhysicalDevice& device) {
    const auto families = device.getQueueFamilyProperties();
    const vk::QueueFlags wanted = vk::QueueFlagBits::eGraphics | vk::QueueFlagBits::eCompute;
    for (std::uint32_t i = 0; i < families.size(); ++i)
        if ((families[i].queueFlags & wanted) == wanted) return i;
    return std::nullopt;
}

std::size_t largestLocalHeap(const vk::PhysicalDeviceMemoryProperties& memory) {
    std::size_t largest = 0;
    for (std::uint32_t i = 0; i < memory.memoryHeapCount; ++i)
        if (memory.memoryHeaps[i].flags & vk::MemoryHeapFlagBits::eDeviceLocal)
            largest = std::max<std::size_t>(largest, memory.memoryHeaps[i].size);
    return largest;
}

/// Sample counts that images of bytes and of depth have alike, as bits; none where locations are the device's
/// own.
std::uint32_t standardSamplesOf(const vk::PhysicalDeviceLimits& limits) {
    if (!limits.standardSampleLocations) return 0;
    return static_cast<std::uint32_t>(limits.framebufferColorSampleCounts &
                                      limits.framebufferDepthSampleCounts &
                                      limits.sampledImageColorSampleCounts);
}

DeviceTraits traitsOf(const vk::raii::PhysicalDevice& device) {
    const auto properties = device.getProperties();
    const auto features =
        device.getFeatures2<vk::PhysicalDeviceFeatures2, vk::PhysicalDeviceVulkan12Features>();
    const vk::PhysicalDeviceFeatures& base = features.get<vk::PhysicalDeviceFeatures2>().features;
    const auto& newer = features.get<vk::PhysicalDeviceVulkan12Features>();
    DeviceTraits traits;
    traits.name = properties.deviceName.data();
    traits.real_gpu = properties.deviceType != vk::PhysicalDeviceType::eCpu;
    if (!traits.real_gpu) traits.loop_turns = 65535;
    traits.fp64 = base.shaderFloat64, traits.int64 = base.shaderInt64;
    traits.int64_atomics = newer.shaderBufferInt64Atomics;
    traits.geometry_shader = base.geometryShader, traits.fragment_stores = base.fragmentStoresAndAtomics;
    traits.conservative_rasterization =
        contains(device.enumerateDeviceExtensionProperties(), &vk::ExtensionProperties::extensionName,
                 VK_EXT_CONSERVATIVE_RASTERIZATION_EXTENSION_NAME);
    traits.max_target_px =
        std::min({properties.limits.maxFramebufferWidth, properties.limits.maxFramebufferHeight,
                  properties.limits.maxViewportDimensions[0], properties.limits.maxViewportDimensions[1],
                  properties.limits.maxImageDimension2D});
    traits.standard_samples = standardSamplesOf(properties.limits);
    traits.subpixel_bits = properties.limits.subPixelPrecisionBits;
    traits.max_stage_buffers = properties.limits.maxPerStageDescriptorStorageBuffers;
    traits.max_shared_bytes = properties.limits.maxComputeSharedMemorySize;
    traits.max_storage_bytes = properties.limits.maxStorageBufferRange;
    traits.max_uniform_bytes = properties.limits.maxUniformBufferRange;
    traits.max_heap_bytes = largestLocalHeap(device.getMemoryProperties());
    if (const auto family = queueFamilyOf(device);
        family && device.getQueueFamilyProperties()[*family].timestampValidBits > 0)
        traits.tick_ns = properties.limits.timestampPeriod;
    return traits;
}

/// Real GPUs first; otherwise as the loader lists them.
std::vector<vk::raii::PhysicalDevice> sortedDevices(const vk::raii::Instance& instance) {
    std::vector<vk::raii::PhysicalDevice> devices;
    for (vk::raii::PhysicalDevice& device : vk::raii::PhysicalDevices(instance))
        if (device.getProperties().apiVersion >= kApiVersion && queueFamilyOf(device))
            devices.push_back(std::move(device));
    std::stable_partition(devices.begin(), devices.end(),
                          [](const vk::raii::PhysicalDevice& d) { return traitsOf(d).real_gpu; });
    return devices;
}

vk::raii::Device openDevice(const vk::raii::PhysicalDevice& physical, const DeviceTraits& traits) {
    const float priority = 1.0f;
    const vk::DeviceQueueCreateInfo queue({}, queueFamilyOf(physical).value(), 1, &priority);
    std::vector<const char*> extensions;
    if (traits.conservative_rasterization)
        extensions.push_back(VK_EXT_CONSERVATIVE_RASTERIZATION_EXTENSION_NAME);
    vk::StructureChain<vk::DeviceCreateInfo, vk::PhysicalDeviceFeatures2, vk::PhysicalDeviceVulkan12Features>
        chain;
    auto& info = chain.get<vk::DeviceCreateInfo>();
    info.setQueueCreateInfos(queue).setPEnabledExtensionNames(extensions);
    auto& base = chain.get<vk::PhysicalDeviceFeatures2>().features;
    base.shaderFloat64 = traits.fp64, base.shaderInt64 = traits.int64;
    base.geometryShader = traits.geometry_shader;
    base.fragmentStoresAndAtomics = traits.fragment_stores;
    base.sampleRateShading = physical.getFeatures().sampleRateShading;
    chain.get<vk::PhysicalDeviceVulkan12Features>().shaderBufferInt64Atomics = traits.int64_atomics;
    return {physical, info};
}

VKAPI_ATTR VkBool32 VKAPI_CALL collectMessage(VkDebugUtilsMessageSeverityFlagBitsEXT,
                                              VkDebugUtilsMessageTypeFlagsEXT,
                                              const VkDebugUtilsMessengerCallbackDataEXT* data,
                                              void* messages) {
    static_cast<std::vector<std::string>*>(messages)->push_back(data->pMessage);
    return VK_FALSE;
}

vk::DebugUtilsMessengerCreateInfoEXT messengerInfo(std::vector<std::string>& messages) {
    using Severity = vk::DebugUtilsMessageSeverityFlagBitsEXT;
    using Type = vk::DebugUtilsMessageTypeFlagBitsEXT;
    return {{},
            Severity::eWarning | Severity::eError,
            Type::eValidation | Type::ePerformance,
            collectMessage,
            &messages};
}

}  // namespace

std::vector<DeviceTraits> listDevices() {
    std::vector<DeviceTraits> all;
    try {
        const vk::raii::Context context;
        const vk::raii::Instance instance = makeInstance(context, false);
        for (const vk::raii::PhysicalDevice& device : sortedDevices(instance))
            all.push_back(traitsOf(device));
    } catch (const std::runtime_error&) {  // no loader, no driver: no devices
    }
    return all;
}

std::optional<std::string> whatIsMissing(const DeviceTraits& traits) {
    std::vector<std::string> missing;
    if (!traits.fp64) missing.push_back("64-bit floats");
    if (!traits.int64) missing.push_back("64-bit integers");
    if (!traits.int64_atomics) missing.push_back("64-bit atomics");
    if (!traits.fragment_stores) missing.push_back("stores from fragments");
    if (traits.max_stage_buffers < kMostBindings)
        missing.push_back(fmt::format("room for {} storage buffers a shader", kMostBindings));
    if (missing.empty()) return std::nullopt;
    return fmt::format("{} has no {}", traits.name, fmt::join(missing, ", "));
}

Device::Device() {
    copies_reads_ = isSet("EDGEWISE_COPY_READS"), validated_ = isSet("EDGEWISE_VALIDATION");
    if (validated_ && !hasLayer(context_, kValidationLayer))
        throw FailureError("EDGEWISE_VALIDATION",
                           fmt::format("the layer {} is not installed", kValidationLayer));
    try {
        instance_.emplace(makeInstance(context_, validated_));
    } catch (const vk::SystemError& error) {
        throw DeviceError(fmt::format("there is no Vulkan driver ({})", error.what()));
    }
    if (validated_) messenger_.emplace(*instance_, messengerInfo(messages_));
    std::string why = "this machine has none with Vulkan 1.2";
    for (vk::raii::PhysicalDevice& device : sortedDevices(*instance_)) {
        traits_ = traitsOf(device);
        if (const auto missing = whatIsMissing(traits_)) {
            why = *missing;
            continue;
        }
        physical_.emplace(std::move(device));
        break;
    }
    if (!physical_) throw DeviceError(why);
    memory_ = physical_->getMemoryProperties();
    device_.emplace(openDevice(*physical_, traits_));
    const std::uint32_t family = queueFamilyOf(*physical_).value();
    queue_.emplace(*device_, family, 0);
    command_pool_.emplace(*device_,
                          vk::CommandPoolCreateInfo(vk::CommandPoolCreateFlagBits::eTransient, family));
}

Device::~Device() = default;

std::optional<std::uint32_t> Device::memoryType(std::uint32_t allowed, vk::MemoryPropertyFlags wanted) const {
    for (std::uint32_t i = 0; i < memory_.memoryTypeCount; ++i)
        if ((allowed >> i & 1u) && (memory_.memoryTypes[i].propertyFlags & wanted) == wanted) return i;
    return std::nullopt;
}

void Device::run(const vk::raii::CommandBuffer& commands) const {
    const vk::raii::Fence done(*device_, vk::FenceCreateInfo());
    const vk::CommandBuffer list = *commands;
    try {
        queue_->submit(vk::SubmitInfo({}, {}, list), *done);
        if (device_->waitForFences(*done, true, UINT64_MAX) != vk::Result::eSuccess)
            throw DeviceError("the device did not finish");
    } catch (const vk::DeviceLostError&) {
        throw DeviceError(fmt::format("{} was lost", traits_.name));
    }
}

void Device::setName(vk::ObjectType type, std::uint64_t handle, const std::string& text) const {
    if (validated_) device_->setDebugUtilsObjectNameEXT({type, handle, text.c_str()});
}

}  // namespace edgewise::vulkan
