// The compute pass that lights the engine's views.
#include "Example/ForkLight.h"

#include <cmath>
#include <iterator>

#include "ForkLightShader.h"

namespace Fork
{

using namespace Lantern;

namespace
{

constexpr uint32_t ReadCount = 9;
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
	constexpr VkImageUsageFlags Usage = VK_IMAGE_USAGE_STORAGE_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT;
	FError Error = Lit.Create(Owner, TextureSize, Format, Usage, VK_IMAGE_ASPECT_COLOR_BIT);
	if (Error.empty()) { Error = NoMask.Create(Owner, {1, 1}, VK_FORMAT_R32_UINT, VK_IMAGE_USAGE_SAMPLED_BIT, VK_IMAGE_ASPECT_COLOR_BIT); }
	return Error.empty() ? Pass.Create(Owner, {ReadCount, 1, {ForkLightShader, sizeof(ForkLightShader)}, sizeof(FPush)}) : Error;
}

void FForkLight::Run(
    VkCommandBuffer Commands, const FForkFrame& Frame, const FForkRaster& Raster, const FRTModuleOutputs& Outputs, uint32_t LampNumber)
{
	FPush Push = MakePush(Frame, LampNumber);
	const auto GetView = [](IRTTexture& Texture) { return reinterpret_cast<VkImageView>(Texture.GetNative(ERTNative::ImageView)); };
	// The shader does not read a null output. Any other image of its kind stands in for it.
	std::vector<FBoundImage> Images = {{Raster.Normals.View}, {Raster.BaseColor.View}, {Raster.Depth.ReadView, FForkRaster::DepthLayout}};
	Images.resize(ReadCount);
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
	Images.push_back({Lit.View, VK_IMAGE_LAYOUT_GENERAL});
	Transition(Commands, Lit.Image, VK_IMAGE_ASPECT_COLOR_BIT, VK_IMAGE_LAYOUT_UNDEFINED, VK_IMAGE_LAYOUT_GENERAL);
	Pass.Run(Commands, Frame.View, Images, &Push);
}

} // namespace Fork
