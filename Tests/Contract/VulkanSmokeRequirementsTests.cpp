// What an engine's vkCreateDevice must enable: its own lists and Lantern's in one, and lists that exclude each other.
#include "VulkanSmokeEngine.h"

#include <set>

namespace Lantern
{
namespace
{

class FVulkanSmokeRequirements : public FVulkanSmokeTest
{
protected:
	void SetUp() override
	{
		FVulkanSmokeTest::SetUp();
		if (IsSkipped() || HasFatalFailure()) { return; }
		ASSERT_NO_FATAL_FAILURE(StartEngine(Engine, Device->GetCapabilities().DeviceName));
	}
	void TearDown() override
	{
		EXPECT_EQ(Engine.Messages, "");
		FVulkanSmokeTest::TearDown();
	}
	FRTStatus Get(const FRTVulkanRequirementsDesc& Desc) { return GetVulkanRequirements(Desc, Requirements.ReleaseAndGetAddress()); }
	void ExpectRefused(const FRTVulkanRequirementsDesc& Desc, ERTResult Code, std::initializer_list<const char*> Parts)
	{
		const FRTStatus Status = Get(Desc);
		EXPECT_EQ(Status.Code, Code);
		for (const char* Part : Parts) { EXPECT_NE(strstr(Status.Message, Part), nullptr) << Status.Message; }
		EXPECT_FALSE(Requirements);
	}
	/// Creates the engine's device with what Requirements says, and lets Lantern take it over.
	void CreateAndAdopt(const VkPhysicalDeviceFeatures* Enabled = nullptr)
	{
		const void* const Chain = Requirements->MergeFeatures();
		ASSERT_TRUE(Engine.CreateDevice(Chain, Requirements->GetExtensionCount(), Requirements->GetExtensions(), Enabled));
		TRTRef<IRTDevice> Adopted;
		ASSERT_OK(AdoptVulkanDevice(Engine.Describe(Requirements.Get()), Adopted.ReleaseAndGetAddress()));
		EXPECT_EQ(Adopted->GetCapabilities().Rung, Device->GetCapabilities().Rung);
	}

	FEngine Engine;
	TRTRef<IRTVulkanRequirements> Requirements;
};

TEST_F(FVulkanSmokeRequirements, ExtensionsOfTheEngineComeFirstAndOnce)
{
	ASSERT_OK(Get(Engine.DescribeRequirements()));
	std::vector<std::string> Alone;
	for (uint32_t Index = 0; Index < Requirements->GetExtensionCount(); ++Index)
	{
		Alone.emplace_back(Requirements->GetExtensions()[Index]);
	}
	ASSERT_FALSE(Alone.empty());
	// One that Lantern needs too, one that it does not, and one twice. The strings need not outlive the call.
	std::vector<std::string> Own = {VK_EXT_DEPTH_CLIP_ENABLE_EXTENSION_NAME, Alone[0], VK_EXT_DEPTH_CLIP_ENABLE_EXTENSION_NAME};
	std::vector<const char*> Names;
	for (const std::string& Name : Own) { Names.push_back(Name.c_str()); }
	FRTVulkanRequirementsDesc Desc = Engine.DescribeRequirements();
	Desc.Extensions = Names.data();
	Desc.ExtensionCount = 3;
	ASSERT_OK(Get(Desc));
	for (std::string& Name : Own) { Name.assign(Name.size(), 'x'); }
	std::set<std::string> Unique;
	for (uint32_t Index = 0; Index < Requirements->GetExtensionCount(); ++Index) { Unique.insert(Requirements->GetExtensions()[Index]); }
	EXPECT_EQ(Unique.size(), Requirements->GetExtensionCount());
	EXPECT_EQ(Unique.size(), Alone.size() + 1);
	EXPECT_STREQ(Requirements->GetExtensions()[0], VK_EXT_DEPTH_CLIP_ENABLE_EXTENSION_NAME);
	EXPECT_EQ(Requirements->GetExtensions()[1], Alone[0]);
	CreateAndAdopt();
}

TEST_F(FVulkanSmokeRequirements, TheEnginesChainIsChangedByTheMergeAlone)
{
	VkPhysicalDeviceVulkan12Features Vulkan12{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES};
	Vulkan12.hostQueryReset = VK_TRUE;
	VkPhysicalDeviceFeatures2 Chain{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2, &Vulkan12};
	FRTVulkanRequirementsDesc Desc = Engine.DescribeRequirements();
	Desc.FeatureChain = &Chain;
	ASSERT_OK(Get(Desc));
	EXPECT_EQ(Vulkan12.pNext, nullptr) << "an engine asks for several devices before it chooses";
	EXPECT_FALSE(Vulkan12.timelineSemaphore);
	EXPECT_EQ(Requirements->MergeFeatures(), &Chain);
	EXPECT_TRUE(Vulkan12.timelineSemaphore);
	EXPECT_TRUE(Vulkan12.hostQueryReset);
	EXPECT_TRUE(Chain.features.shaderInt64);
	std::set<VkStructureType> Types;
	for (auto* Item = reinterpret_cast<const VkBaseInStructure*>(&Chain); Item != nullptr; Item = Item->pNext)
	{
		EXPECT_TRUE(Types.insert(Item->sType).second) << Item->sType;
	}
	EXPECT_EQ(Types.count(VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES), 1u);
	CreateAndAdopt();
}

TEST_F(FVulkanSmokeRequirements, FeaturesOfVulkan10KeepTheirPlace)
{
	VkPhysicalDeviceFeatures Enabled{};
	Enabled.fillModeNonSolid = VK_TRUE;
	VkPhysicalDeviceDepthClipEnableFeaturesEXT Own{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_DEPTH_CLIP_ENABLE_FEATURES_EXT, nullptr, VK_TRUE};
	const char* const Names[] = {VK_EXT_DEPTH_CLIP_ENABLE_EXTENSION_NAME, VK_EXT_DESCRIPTOR_INDEXING_EXTENSION_NAME,
	    VK_KHR_DRAW_INDIRECT_COUNT_EXTENSION_NAME, VK_KHR_SHADER_DRAW_PARAMETERS_EXTENSION_NAME};
	FRTVulkanRequirementsDesc Desc = Engine.DescribeRequirements();
	Desc.FeatureChain = &Own;
	Desc.EnabledFeatures = &Enabled;
	Desc.Extensions = Names;
	Desc.ExtensionCount = 4;
	ASSERT_OK(Get(Desc));
	EXPECT_EQ(Requirements->MergeFeatures(), &Own);
	EXPECT_TRUE(Enabled.fillModeNonSolid && Enabled.shaderInt64);
	for (auto* Item = reinterpret_cast<const VkBaseInStructure*>(&Own); Item != nullptr; Item = Item->pNext)
	{
		EXPECT_NE(Item->sType, VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2) << "Vulkan allows one of both";
	}
	CreateAndAdopt(&Enabled); // the layers check that the extensions' features are on
}

TEST_F(FVulkanSmokeRequirements, PromotedStructuresAreRefusedByBothNames)
{
	VkPhysicalDeviceBufferDeviceAddressFeatures Addresses{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_BUFFER_DEVICE_ADDRESS_FEATURES};
	VkPhysicalDeviceSynchronization2Features Synchronization{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SYNCHRONIZATION_2_FEATURES};
	VkPhysicalDevice16BitStorageFeatures Storage{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_16BIT_STORAGE_FEATURES};
	VkPhysicalDeviceFeatures2 Chain{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2, &Addresses};
	FRTVulkanRequirementsDesc Desc = Engine.DescribeRequirements();
	Desc.FeatureChain = &Chain;
	ExpectRefused(Desc, ERTResult::InvalidArgument, {"VkPhysicalDeviceBufferDeviceAddressFeatures", "VkPhysicalDeviceVulkan12Features"});
	Desc.FeatureChain = &Synchronization;
	ExpectRefused(Desc, ERTResult::InvalidArgument, {"VkPhysicalDeviceSynchronization2Features", "VkPhysicalDeviceVulkan13Features"});
	Desc.FeatureChain = &Storage;
	ExpectRefused(Desc, ERTResult::InvalidArgument, {"VkPhysicalDevice16BitStorageFeatures", "VkPhysicalDeviceVulkan11Features"});
	const char* const Old[] = {"VK_EXT_buffer_device_address"};
	Desc.FeatureChain = nullptr;
	Desc.Extensions = Old;
	Desc.ExtensionCount = 1;
	ExpectRefused(Desc, ERTResult::InvalidArgument, {"VK_EXT_buffer_device_address", "VkPhysicalDeviceVulkan12Features"});
}

TEST_F(FVulkanSmokeRequirements, AnInstanceThatIsTooOldIsBlamedAndNotTheDevice)
{
	FRTVulkanRequirementsDesc Desc = Engine.DescribeRequirements();
	Desc.InstanceVersion = VK_API_VERSION_1_2;
	ExpectRefused(Desc, ERTResult::Unsupported, {"instance was created for Vulkan 1.2", "1.3"});
	Desc.InstanceVersion = 0;
	ExpectRefused(Desc, ERTResult::Unsupported, {"instance was created for Vulkan 1.0"});
	EXPECT_EQ(strstr(Get(Desc).Message, Device->GetCapabilities().DeviceName), nullptr);
}

TEST_F(FVulkanSmokeRequirements, WrongListsAreNamed)
{
	FRTVulkanRequirementsDesc Desc = Engine.DescribeRequirements();
	Desc.Instance = VK_NULL_HANDLE;
	ExpectRefused(Desc, ERTResult::InvalidArgument, {"Instance is null"});
	Desc = Engine.DescribeRequirements();
	Desc.PhysicalDevice = VK_NULL_HANDLE;
	ExpectRefused(Desc, ERTResult::InvalidArgument, {"PhysicalDevice is null"});
	Desc = Engine.DescribeRequirements();
	Desc.ExtensionCount = ~0u;
	ExpectRefused(Desc, ERTResult::InvalidArgument, {"Extensions is null"});
	const char* const Names[] = {VK_EXT_DEPTH_CLIP_ENABLE_EXTENSION_NAME, nullptr};
	Desc.Extensions = Names;
	Desc.ExtensionCount = 2;
	ExpectRefused(Desc, ERTResult::InvalidArgument, {"Extensions[1] is null"});
	Desc = Engine.DescribeRequirements();
	VkPhysicalDeviceVulkan12Features Vulkan12{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES, &Vulkan12};
	Desc.FeatureChain = &Vulkan12;
	ExpectRefused(Desc, ERTResult::InvalidArgument, {"FeatureChain has no end"});
	VkPhysicalDeviceFeatures2 Core{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2};
	VkPhysicalDeviceFeatures Enabled{};
	Desc.FeatureChain = &Core;
	Desc.EnabledFeatures = &Enabled;
	ExpectRefused(Desc, ERTResult::InvalidArgument, {"EnabledFeatures", "VkPhysicalDeviceFeatures2"});
}

TEST_F(FVulkanSmokeRequirements, ATakeOverWithoutAHandleIsRefusedByItsName)
{
	ASSERT_OK(Get(Engine.DescribeRequirements()));
	ASSERT_NO_FATAL_FAILURE(CreateAndAdopt());
	const auto Refuse = [&](auto Member, const char* Name) {
		FRTVulkanExternalDesc Desc = Engine.Describe(Requirements.Get());
		Desc.*Member = {};
		TRTRef<IRTDevice> Adopted;
		const FRTStatus Status = AdoptVulkanDevice(Desc, Adopted.ReleaseAndGetAddress());
		EXPECT_EQ(Status.Code, ERTResult::InvalidArgument);
		EXPECT_NE(strstr(Status.Message, Name), nullptr) << Status.Message;
	};
	Refuse(&FRTVulkanExternalDesc::Instance, "FRTVulkanExternalDesc::Instance is null");
	Refuse(&FRTVulkanExternalDesc::PhysicalDevice, "FRTVulkanExternalDesc::PhysicalDevice is null");
	Refuse(&FRTVulkanExternalDesc::Device, "FRTVulkanExternalDesc::Device is null");
	Refuse(&FRTVulkanExternalDesc::Queue, "FRTVulkanExternalDesc::Queue is null");
	Refuse(&FRTVulkanExternalDesc::Requirements, "FRTVulkanExternalDesc::Requirements is null");
	FRTVulkanExternalDesc Desc = Engine.Describe(Requirements.Get());
	Desc.QueueFamily = ~0u;
	TRTRef<IRTDevice> Adopted;
	const FRTStatus Status = AdoptVulkanDevice(Desc, Adopted.ReleaseAndGetAddress());
	EXPECT_EQ(Status.Code, ERTResult::InvalidArgument);
	EXPECT_NE(strstr(Status.Message, "QueueFamily is 4294967295"), nullptr) << Status.Message;
}

} // namespace
} // namespace Lantern
