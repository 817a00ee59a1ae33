// The raw dispatch: its push constants, command buffer and timing.
#include "Bench/BenchRawShadow.h"

#include <cmath>

namespace Lantern
{

namespace
{
constexpr uint32_t GroupX = 8, GroupY = 8;
constexpr uint64_t WaitNs = 120'000'000'000ull;

/// As in Shaders/RawShadow.glsl.
struct FRawPush
{
	glm::vec3 Camera;
	float Near;
	glm::vec3 FirstRay;
	uint32_t FrameIndex;
	glm::vec3 StepX;
	uint32_t Seed;
	glm::vec3 StepY;
	float OneMinusCos;
	glm::vec3 SunTangent;
	uint32_t Size;
	glm::vec3 SunBitangent;
	float MaxDistance;
	glm::vec3 TowardsSun;
	uint32_t InstanceMask;
	float ObjectReach;
};
static_assert(sizeof(FRawPush) == RawPushBytes, "shared with shaders");

/// HashPcg of Shaders/Library/Random.glsl: the seed is the same for all pixels.
uint32_t HashPcg(uint32_t V)
{
	const uint32_t State = V * 747796405u + 2891336453u;
	const uint32_t Word = ((State >> ((State >> 28u) + 4u)) ^ State) * 277803737u;
	return (Word >> 22u) ^ Word;
}

FRawPush MakePush(const FRawShadowDesc& Desc)
{
	const FViewConstants View = MakeViewConstants(Desc.View, Desc.Scene->GetScene().GetOrigin());
	const FSceneConstants Scene = Desc.Scene->GetScene().GetConstants();
	FRawPush Push{};
	Push.Camera = View.CameraPosition;
	Push.Near = View.Near;
	Push.StepX = View.CameraRight * (View.RayScale.x * View.Near);
	Push.StepY = View.CameraUp * (View.RayScale.y * View.Near);
	Push.FirstRay = (View.CameraForward + View.CameraRight * View.RayOffset.x + View.CameraUp * View.RayOffset.y) * View.Near +
	                0.5f * (Push.StepX + Push.StepY);
	Push.FrameIndex = View.FrameIndex;
	Push.Seed = HashPcg(View.Seed);
	Push.Size = View.Width | (View.Height << 16);
	Push.OneMinusCos = Scene.SunOneMinusCos;
	Push.MaxDistance = Desc.MaxDistance;
	Push.InstanceMask = Desc.InstanceMask;
	Push.ObjectReach = Scene.ObjectReach;
	// The basis of MakeBasis in Shaders/Library/Math.glsl.
	const glm::vec3 N = -Scene.SunDirection;
	const float S = N.z >= 0.0f ? 1.0f : -1.0f, A = -1.0f / (S + N.z), B = N.x * N.y * A;
	Push.SunTangent = {1.0f + S * N.x * N.x * A, S * B, -S * N.x};
	Push.SunBitangent = {B, S + N.y * N.y * A, -N.y};
	Push.TowardsSun = N;
	return Push;
}

VkImageMemoryBarrier2 MakeImageBarrier(VkImage Image, VkImageLayout Before, VkImageLayout After)
{
	VkImageMemoryBarrier2 Barrier{VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER_2};
	Barrier.srcStageMask = Barrier.dstStageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT;
	Barrier.srcAccessMask = VK_ACCESS_2_MEMORY_WRITE_BIT;
	Barrier.dstAccessMask = VK_ACCESS_2_MEMORY_READ_BIT | VK_ACCESS_2_MEMORY_WRITE_BIT;
	Barrier.oldLayout = Before;
	Barrier.newLayout = After;
	Barrier.srcQueueFamilyIndex = Barrier.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
	Barrier.image = Image;
	Barrier.subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1};
	return Barrier;
}

VkDependencyInfo MakeDependency(const VkImageMemoryBarrier2& Barrier)
{
	VkDependencyInfo Info{VK_STRUCTURE_TYPE_DEPENDENCY_INFO};
	Info.imageMemoryBarrierCount = 1;
	Info.pImageMemoryBarriers = &Barrier;
	return Info;
}
} // namespace

FRTStatus FRawShadow::Create(const FRawShadowDesc& Desc, std::unique_ptr<FRawShadow>& Out)
{
	std::unique_ptr<FRawShadow> Raw(new FRawShadow(Desc));
	FRTStatus Status = Raw->Initialise();
	if (Status) { Out = std::move(Raw); }
	return Status;
}

FRTStatus FRawShadow::Initialise()
{
	if (FRTStatus S = Vulkan.Load(*Desc.Device); !S) { return S; }
	if (FRTStatus S = CreateOutput(); !S) { return S; }
	if (FRTStatus S = Tables.Create(OutputView); !S) { return S; }
	if (FRTStatus S = Desc.bPipeline ? CreateRayPipeline() : CreateComputePipeline(); !S) { return S; }
	if (FRTStatus S = CreateCommands(); !S) { return S; }
	return Record();
}

FRawShadow::~FRawShadow()
{
	if (!Vulkan.Device) { return; }
	const VkDevice Device = Vulkan.Device;
	Vulkan.DestroyFence(Device, Fence, nullptr);
	Vulkan.DestroyQueryPool(Device, Queries, nullptr);
	Vulkan.DestroyCommandPool(Device, CommandPool, nullptr);
	Vulkan.DestroyPipeline(Device, Pipeline, nullptr);
	Vulkan.DestroyImageView(Device, OutputView, nullptr);
	for (const VkShaderModule Module : Modules) { Vulkan.DestroyShaderModule(Device, Module, nullptr); }
}

FRTStatus FRawShadow::CreateOutput()
{
	FRTTextureDesc Texture;
	Texture.Width = Desc.View.Width;
	Texture.Height = Desc.View.Height;
	Texture.Format = ERTFormat::R16_FLOAT; // what the plugin writes
	Texture.Usage = ERTTextureUsage::Storage | ERTTextureUsage::CopySource;
	Texture.Name = "RawVisibility";
	if (FRTStatus S = Desc.Device->CreateTexture(Texture, Output.ReleaseAndGetAddress()); !S) { return S; }
	const FRTBufferDesc Buffer{uint64_t(Texture.Width) * Texture.Height * 2, ERTBufferUsage::CopyDest, ERTMemory::Readback, "RawReadback"};
	if (FRTStatus S = Desc.Device->CreateBuffer(Buffer, Readback.ReleaseAndGetAddress()); !S) { return S; }
	VkImageViewCreateInfo View{VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO};
	View.image = reinterpret_cast<VkImage>(Output->GetNative(ERTNative::Image));
	View.viewType = VK_IMAGE_VIEW_TYPE_2D;
	View.format = VK_FORMAT_R16_SFLOAT;
	View.subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1};
	return CheckVulkan(Vulkan.CreateImageView(Vulkan.Device, &View, nullptr, &OutputView), "vkCreateImageView");
}

FRTStatus FRawShadow::CreateCommands()
{
	VkCommandPoolCreateInfo Pool{VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO};
	Pool.queueFamilyIndex = Vulkan.QueueFamily;
	VkResult Result = Vulkan.CreateCommandPool(Vulkan.Device, &Pool, nullptr, &CommandPool);
	VkCommandBufferAllocateInfo Buffer{VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO};
	Buffer.commandPool = CommandPool;
	Buffer.level = VK_COMMAND_BUFFER_LEVEL_PRIMARY;
	Buffer.commandBufferCount = 1;
	Result = Result ? Result : Vulkan.AllocateCommandBuffers(Vulkan.Device, &Buffer, &Commands);
	VkQueryPoolCreateInfo Query{VK_STRUCTURE_TYPE_QUERY_POOL_CREATE_INFO};
	Query.queryType = VK_QUERY_TYPE_TIMESTAMP;
	Query.queryCount = 2;
	Result = Result ? Result : Vulkan.CreateQueryPool(Vulkan.Device, &Query, nullptr, &Queries);
	const VkFenceCreateInfo FenceInfo{VK_STRUCTURE_TYPE_FENCE_CREATE_INFO};
	Result = Result ? Result : Vulkan.CreateFence(Vulkan.Device, &FenceInfo, nullptr, &Fence);
	return CheckVulkan(Result, "creating command buffer, queries and fence");
}

// Recorded once. What the timestamps enclose is what the frame graph's enclose for the plugin's pass: the barrier of
// the output, and the dispatch.
FRTStatus FRawShadow::Record()
{
	const VkImage Image = reinterpret_cast<VkImage>(Output->GetNative(ERTNative::Image));
	const VkPipelineBindPoint Point = Desc.bPipeline ? VK_PIPELINE_BIND_POINT_RAY_TRACING_KHR : VK_PIPELINE_BIND_POINT_COMPUTE;
	const VkShaderStageFlags Stages = Desc.bPipeline ? VK_SHADER_STAGE_RAYGEN_BIT_KHR : VK_SHADER_STAGE_COMPUTE_BIT;
	const FRawPush Push = MakePush(Desc);
	const uint32_t Width = Desc.View.Width, Height = Desc.View.Height;

	const VkCommandBufferBeginInfo Begin{VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO};
	if (FRTStatus S = CheckVulkan(Vulkan.BeginCommandBuffer(Commands, &Begin), "vkBeginCommandBuffer"); !S) { return S; }
	Vulkan.CmdResetQueryPool(Commands, Queries, 0, 2);
	Vulkan.CmdWriteTimestamp2(Commands, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, Queries, 0);
	const auto ToWrite = MakeImageBarrier(Image, VK_IMAGE_LAYOUT_UNDEFINED, VK_IMAGE_LAYOUT_GENERAL);
	const VkDependencyInfo BeforeDispatch = MakeDependency(ToWrite);
	Vulkan.CmdPipelineBarrier2(Commands, &BeforeDispatch);
	Vulkan.CmdBindPipeline(Commands, Point, Pipeline);
	Vulkan.CmdBindDescriptorSets(Commands, Point, Tables.GetLayout(), 0, 1, &Tables.GetSet(), 0, nullptr);
	Vulkan.CmdPushConstants(Commands, Tables.GetLayout(), Stages, 0, sizeof(Push), &Push);
	if (Desc.bPipeline)
	{
		const VkStridedDeviceAddressRegionKHR None{};
		Vulkan.CmdTraceRaysKHR(Commands, &RayGenRegion, &MissRegion, &HitRegion, &None, Width, Height, 1);
	}
	else { Vulkan.CmdDispatch(Commands, (Width + GroupX - 1) / GroupX, (Height + GroupY - 1) / GroupY, 1); }
	Vulkan.CmdWriteTimestamp2(Commands, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, Queries, 1);
	const auto ToCopy = MakeImageBarrier(Image, VK_IMAGE_LAYOUT_GENERAL, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL);
	const VkDependencyInfo BeforeCopy = MakeDependency(ToCopy);
	Vulkan.CmdPipelineBarrier2(Commands, &BeforeCopy);
	VkBufferImageCopy Copy{};
	Copy.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};
	Copy.imageExtent = {Width, Height, 1};
	Vulkan.CmdCopyImageToBuffer(Commands, Image, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL,
	    reinterpret_cast<VkBuffer>(Readback->GetNative(ERTNative::Buffer)), 1, &Copy);
	VkMemoryBarrier2 ToHost{VK_STRUCTURE_TYPE_MEMORY_BARRIER_2};
	ToHost.srcStageMask = VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT;
	ToHost.srcAccessMask = VK_ACCESS_2_TRANSFER_WRITE_BIT;
	ToHost.dstStageMask = VK_PIPELINE_STAGE_2_HOST_BIT;
	ToHost.dstAccessMask = VK_ACCESS_2_HOST_READ_BIT;
	VkDependencyInfo BeforeRead{VK_STRUCTURE_TYPE_DEPENDENCY_INFO};
	BeforeRead.memoryBarrierCount = 1;
	BeforeRead.pMemoryBarriers = &ToHost;
	Vulkan.CmdPipelineBarrier2(Commands, &BeforeRead);
	return CheckVulkan(Vulkan.EndCommandBuffer(Commands), "vkEndCommandBuffer");
}

FRTStatus FRawShadow::Run(double& OutMs)
{
	VkSubmitInfo Submit{VK_STRUCTURE_TYPE_SUBMIT_INFO};
	Submit.commandBufferCount = 1;
	Submit.pCommandBuffers = &Commands;
	VkResult Result = Vulkan.QueueSubmit(Vulkan.Queue, 1, &Submit, Fence);
	Result = Result ? Result : Vulkan.WaitForFences(Vulkan.Device, 1, &Fence, VK_TRUE, WaitNs);
	Result = Result ? Result : Vulkan.ResetFences(Vulkan.Device, 1, &Fence);
	uint64_t Ticks[2] = {};
	Result = Result ? Result
	                : Vulkan.GetQueryPoolResults(Vulkan.Device, Queries, 0, 2, sizeof(Ticks), Ticks, sizeof(Ticks[0]),
	                      VK_QUERY_RESULT_64_BIT | VK_QUERY_RESULT_WAIT_BIT);
	OutMs = static_cast<double>(Ticks[1] - Ticks[0]) * Desc.Device->GetCapabilities().TimestampPeriodNs * 1e-6;
	return CheckVulkan(Result, "the dispatch");
}

const uint16_t* FRawShadow::GetPicture() const
{
	return static_cast<const uint16_t*>(const_cast<FRawShadow*>(this)->Readback->GetMapped());
}

FRTStatus FRawShadow::CompileModule(const char* Path, ERTShaderStage Stage, VkShaderModule& Out)
{
	FShaderSource Source{Path, Stage, {}, {}};
	Source.Defines = {{"RAW_GROUP_X", std::to_string(GroupX)}, {"RAW_GROUP_Y", std::to_string(GroupY)}};
	if (Tables.HasMasked()) { Source.Defines.emplace_back("HAS_MASKED", "1"); }
	if (Desc.bCountRays) { Source.Defines.emplace_back("COUNT_RAYS", "1"); }
	FShaderBinary Binary;
	if (FRTStatus S = Desc.Compiler->Compile(Source, Binary); !S) { return S; }
	VkShaderModuleCreateInfo Info{VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO};
	Info.codeSize = Binary.Words.size() * sizeof(uint32_t);
	Info.pCode = Binary.Words.data();
	const VkResult Result = Vulkan.CreateShaderModule(Vulkan.Device, &Info, nullptr, &Out);
	if (Result == VK_SUCCESS) { Modules.push_back(Out); }
	return CheckVulkan(Result, Path);
}

} // namespace Lantern
