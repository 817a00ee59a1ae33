// The compute pass that lights the engine's views.
#include "Example/ForkLight.h"

#include <array>
#include <cmath>
#include <iterator>

#include "ForkLightShader.h"

namespace Fork
{

using namespace Lantern;

namespace
{

constexpr uint32_t GroupSize = 8; // ForkLight.comp
constexpr uint32_t ReadCount = 9, BindingCount = ReadCount + 1;
constexpr ESignal Signals[] = {ESignal::SunShadow, ESignal::AmbientOcclusion, ESignal::DiffuseGI, ESignal::LocalDiffuse};
constexpr uint32_t FirstSignal = 3, FirstMask = FirstSignal + static_cast<uint32_t>(std::size(Signals)); // bindings
constexpr uint32_t GivenMask = 1u << std::size(Signals);

struct FPush
{
	VkOffset2D Offset{};
	VkExtent2D Size{};
	glm::vec3 ToSun{0};
	float Sun = 0.0f, Ambient = 0.0f;
	uint32_t Given = 0;
	glm::vec3 Lamp{0}; // view space
	float LampIntensity = 0.0f;
	uint32_t LampNumber = 0;
	float Near = 0.0f, Far = 0.0f;
	glm::vec2 Tangents{0}, Jitter{0};
};

FPush MakePush(const FForkFrame& Frame, uint32_t LampNumber)
{
	const FForkScene& Scene = Frame.Scene;
	const FCamera& Camera = Scene.Cameras[Frame.View];
	FPush Push{GetViewOffset(Frame.View), ViewSize, glm::vec3(GetWorldToView(Camera) * -Scene.SunDirection), float(FForkLight::Sun),
	    float(FForkLight::Ambient)};
	Push.Lamp = glm::vec3(GetWorldToView(Camera) * (Scene.Lamp - Camera.Position));
	Push.LampIntensity = float(Scene.LampIntensity);
	Push.LampNumber = LampNumber;
	Push.Near = float(Camera.Near);
	Push.Far = float(Camera.Far);
	const double Tangent = std::tan(Camera.FovY * 0.5);
	Push.Tangents = glm::vec2(Tangent * ViewSize.width / ViewSize.height, Tangent);
	Push.Jitter = glm::vec2(Camera.Jitter);
	return Push;
}

} // namespace

FError FForkLight::Create(const FForkDevice& Owner)
{
	Device = Owner.Device;
	constexpr VkImageUsageFlags Usage = VK_IMAGE_USAGE_STORAGE_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT;
	FError Error = Lit.Create(Owner, TextureSize, Format, Usage, VK_IMAGE_ASPECT_COLOR_BIT);
	if (Error.empty()) { Error = NoMask.Create(Owner, {1, 1}, VK_FORMAT_R32_UINT, VK_IMAGE_USAGE_SAMPLED_BIT, VK_IMAGE_ASPECT_COLOR_BIT); }
	if (Error.empty()) { Error = CreateSets(); }
	return Error.empty() ? CreatePipeline() : Error;
}

FError FForkLight::CreateSets()
{
	std::array<VkDescriptorSetLayoutBinding, BindingCount> Bindings{};
	for (uint32_t Index = 0; Index < BindingCount; ++Index)
	{
		const VkDescriptorType Type = Index < ReadCount ? VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE : VK_DESCRIPTOR_TYPE_STORAGE_IMAGE;
		Bindings[Index] = {Index, Type, 1, VK_SHADER_STAGE_COMPUTE_BIT, nullptr};
	}
	VkDescriptorSetLayoutCreateInfo LayoutInfo{VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO};
	LayoutInfo.bindingCount = BindingCount;
	LayoutInfo.pBindings = Bindings.data();
	vkCreateDescriptorSetLayout(Device, &LayoutInfo, nullptr, &SetLayout);
	const VkDescriptorPoolSize Sizes[] = {
	    {VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE, ReadCount * ViewCount}, {VK_DESCRIPTOR_TYPE_STORAGE_IMAGE, ViewCount}};
	VkDescriptorPoolCreateInfo PoolInfo{VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO};
	PoolInfo.maxSets = ViewCount;
	PoolInfo.poolSizeCount = 2;
	PoolInfo.pPoolSizes = Sizes;
	vkCreateDescriptorPool(Device, &PoolInfo, nullptr, &Pool);
	std::array<VkDescriptorSetLayout, ViewCount> Layouts;
	Layouts.fill(SetLayout);
	VkDescriptorSetAllocateInfo Info{VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO};
	Info.descriptorPool = Pool;
	Info.descriptorSetCount = ViewCount;
	Info.pSetLayouts = Layouts.data();
	const VkResult Result = vkAllocateDescriptorSets(Device, &Info, Sets);
	return Result == VK_SUCCESS ? FError() : "vkAllocateDescriptorSets failed with " + std::to_string(Result);
}

FError FForkLight::CreatePipeline()
{
	const VkPushConstantRange Range{VK_SHADER_STAGE_COMPUTE_BIT, 0, sizeof(FPush)};
	VkPipelineLayoutCreateInfo LayoutInfo{VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO};
	LayoutInfo.setLayoutCount = 1;
	LayoutInfo.pSetLayouts = &SetLayout;
	LayoutInfo.pushConstantRangeCount = 1;
	LayoutInfo.pPushConstantRanges = &Range;
	vkCreatePipelineLayout(Device, &LayoutInfo, nullptr, &Layout);
	return CreateComputePipeline(Device, {ForkLightShader, sizeof(ForkLightShader)}, Layout, Pipeline);
}

void FForkLight::WriteSet(VkDescriptorSet Set, const FReadImage* Images)
{
	std::array<VkDescriptorImageInfo, BindingCount> Infos{};
	std::array<VkWriteDescriptorSet, BindingCount> Writes{};
	for (uint32_t Index = 0; Index < BindingCount; ++Index)
	{
		const bool bRead = Index < ReadCount;
		Infos[Index] = bRead ? VkDescriptorImageInfo{VK_NULL_HANDLE, Images[Index].View, Images[Index].Layout}
		                     : VkDescriptorImageInfo{VK_NULL_HANDLE, Lit.View, VK_IMAGE_LAYOUT_GENERAL};
		Writes[Index] = {VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET, nullptr, Set, Index, 0, 1,
		    bRead ? VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE : VK_DESCRIPTOR_TYPE_STORAGE_IMAGE, &Infos[Index], nullptr, nullptr};
	}
	vkUpdateDescriptorSets(Device, BindingCount, Writes.data(), 0, nullptr);
}

void FForkLight::Run(
    VkCommandBuffer Commands, const FForkFrame& Frame, const FForkRaster& Raster, const FRTModuleOutputs& Outputs, uint32_t LampNumber)
{
	FPush Push = MakePush(Frame, LampNumber);
	const auto GetView = [](IRTTexture& Texture) { return reinterpret_cast<VkImageView>(Texture.GetNative(ERTNative::ImageView)); };
	// The shader does not read a null output. Any other image of its kind stands in for it.
	FReadImage Images[ReadCount] = {{Raster.Normals.View}, {Raster.BaseColor.View}, {Raster.Depth.ReadView, FForkRaster::DepthLayout}};
	for (uint32_t Index = 0; Index < std::size(Signals); ++Index)
	{
		IRTTexture* const Output = Outputs.Get(Signals[Index]);
		Images[FirstSignal + Index].View = Output != nullptr ? GetView(*Output) : Raster.Normals.View;
		if (Output != nullptr) { Push.Given |= 1u << Index; }
	}
	const FRTModuleLightMask& Mask = Outputs.LightMask;
	if (Mask.Visibility != nullptr) { Push.Given |= GivenMask; }
	else { Transition(Commands, NoMask.Image, VK_IMAGE_ASPECT_COLOR_BIT, VK_IMAGE_LAYOUT_UNDEFINED, Images[FirstMask].Layout); }
	Images[FirstMask].View = Mask.Visibility != nullptr ? GetView(*Mask.Visibility) : NoMask.View;
	Images[FirstMask + 1].View = Mask.Visibility != nullptr ? GetView(*Mask.Lights) : NoMask.View;
	WriteSet(Sets[Frame.View], Images);
	Transition(Commands, Lit.Image, VK_IMAGE_ASPECT_COLOR_BIT, VK_IMAGE_LAYOUT_UNDEFINED, VK_IMAGE_LAYOUT_GENERAL);
	// The plugin has bound pipelines, sets and push constants of its own: see IRTModuleRenderer::RenderFrame.
	vkCmdBindPipeline(Commands, VK_PIPELINE_BIND_POINT_COMPUTE, Pipeline);
	vkCmdBindDescriptorSets(Commands, VK_PIPELINE_BIND_POINT_COMPUTE, Layout, 0, 1, &Sets[Frame.View], 0, nullptr);
	vkCmdPushConstants(Commands, Layout, VK_SHADER_STAGE_COMPUTE_BIT, 0, sizeof(Push), &Push);
	vkCmdDispatch(Commands, (ViewSize.width + GroupSize - 1) / GroupSize, (ViewSize.height + GroupSize - 1) / GroupSize, 1);
}

FForkLight::~FForkLight()
{
	if (Device != VK_NULL_HANDLE)
	{
		vkDestroyPipeline(Device, Pipeline, nullptr);
		vkDestroyPipelineLayout(Device, Layout, nullptr);
		vkDestroyDescriptorPool(Device, Pool, nullptr);
		vkDestroyDescriptorSetLayout(Device, SetLayout, nullptr);
	}
}

} // namespace Fork
