// The compute pass that composites the plugin's glass.
#include "Example/ForkGlass.h"

#include "Example/ForkLight.h"
#include "ForkGlassShader.h"

namespace Fork
{

using namespace Lantern;

namespace
{

struct FPush
{
	VkOffset2D Offset{};
	VkExtent2D Size{};
	uint32_t bGiven = 0;
};

} // namespace

FError FForkGlass::Create(const FForkDevice& Owner)
{
	constexpr VkImageUsageFlags Usage = VK_IMAGE_USAGE_STORAGE_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT;
	FError Error = Shown.Create(Owner, TextureSize, FForkLight::Format, Usage, VK_IMAGE_ASPECT_COLOR_BIT);
	const auto CreateNull = [&](FForkImage& Image, VkFormat Format) {
		if (Error.empty()) { Error = Image.Create(Owner, {1, 1}, Format, VK_IMAGE_USAGE_SAMPLED_BIT, VK_IMAGE_ASPECT_COLOR_BIT); }
	};
	CreateNull(NoGlass, FForkLight::Format);
	CreateNull(NoLooks, VK_FORMAT_R32G32B32A32_UINT);
	return Error.empty() ? Pass.Create(Owner, {3, 2, {ForkGlassShader, sizeof(ForkGlassShader)}, sizeof(FPush)}) : Error;
}

void FForkGlass::Run(VkCommandBuffer Commands, uint32_t View, const FForkImage& Lit, const FRTModuleTransmission& Glass)
{
	const auto GetView = [](IRTTexture& Texture) { return reinterpret_cast<VkImageView>(Texture.GetNative(ERTNative::ImageView)); };
	const bool bGiven = Glass.Light != nullptr;
	const FPush Push{GetViewOffset(View), ViewSize, bGiven ? 1u : 0u};
	if (!bGiven)
	{
		for (const FForkImage* Image : {&NoGlass, &NoLooks})
		{
			Transition(
			    Commands, Image->Image, VK_IMAGE_ASPECT_COLOR_BIT, VK_IMAGE_LAYOUT_UNDEFINED, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
		}
	}
	Transition(Commands, Lit.Image, VK_IMAGE_ASPECT_COLOR_BIT, VK_IMAGE_LAYOUT_GENERAL, VK_IMAGE_LAYOUT_GENERAL); // it is written
	Transition(Commands, Shown.Image, VK_IMAGE_ASPECT_COLOR_BIT, VK_IMAGE_LAYOUT_UNDEFINED, VK_IMAGE_LAYOUT_GENERAL);
	Pass.Run(Commands, View,
	    {{bGiven ? GetView(*Glass.Light) : NoGlass.View}, {bGiven ? GetView(*Glass.Transmittance) : NoGlass.View},
	        {bGiven ? GetView(*Glass.Looks) : NoLooks.View}, {Lit.View, VK_IMAGE_LAYOUT_GENERAL}, {Shown.View, VK_IMAGE_LAYOUT_GENERAL}},
	    &Push);
}

} // namespace Fork
