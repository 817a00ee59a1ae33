// On the mock: what profiles and channels of lights add to a frame, and that they add nothing where nothing has a use for them.
#include "Support/RendererTestTools.h"

namespace Lantern
{
namespace
{

class FLightProfileMockTest : public FRendererTest
{
protected:
	FRTScene& GetWorld() { return Engine->GetScene().GetScene(); }
	FLightId AddLamp(uint32_t Profile, uint8_t Channels)
	{
		FSceneLight Light;
		Light.Position = {0, 0, 1};
		Light.Color = glm::vec3(1);
		Light.Profile = Profile;
		Light.Channels = Channels;
		return GetWorld().AddLight(Light);
	}
	/// Of what the frame has made.
	bool HasPipeline(const char* Part)
	{
		const std::vector<std::string> Names = Mock().GetCreatedPipelines();
		return std::any_of(Names.begin(), Names.end(), [&](const std::string& Name) { return Name.find(Part) != std::string::npos; });
	}
	bool HasBuffer(const char* Part)
	{
		const std::vector<std::string> Names = Mock().GetCreatedBuffers();
		return std::any_of(Names.begin(), Names.end(), [&](const std::string& Name) { return Name.find(Part) != std::string::npos; });
	}
};

TEST_F(FLightProfileMockTest, LampsWithoutProfilesCostNoneOfIt)
{
	LoadAndRender({.bLights = true});
	(void)AddLamp(0, CHANNELS_DEFAULT | 4);
	Render();
	EXPECT_FALSE(HasPipeline("HAS_LIGHT_PROFILES"));
	EXPECT_FALSE(HasPipeline("HAS_LIGHT_CHANNELS")) << "all share channel 0";
	EXPECT_FALSE(HasPipeline("PixelChannels"));
	EXPECT_FALSE(HasPass("PixelChannels"));
	EXPECT_FALSE(HasBuffer("Profile"));
	EXPECT_FALSE(HasBuffer("Channels"));
}

TEST_F(FLightProfileMockTest, OneLampBringsThemAndTakesThemAway)
{
	LoadAndRender({.bLights = true});
	const uint32_t Profile = GetWorld().AddLightProfile(MakeProfileGrid({{0, 90}, {0}, {1, 2}}));
	Render();
	EXPECT_FALSE(HasPipeline("HAS_LIGHT_PROFILES")) << "no lamp has it";
	EXPECT_TRUE(HasBuffer("LightProfiles"));
	EXPECT_TRUE(HasBuffer("LightProfileTexels"));
	const FLightId Lamp = AddLamp(Profile, CHANNELS_DEFAULT);
	Render();
	EXPECT_TRUE(HasPipeline("HAS_LIGHT_PROFILES"));
	EXPECT_FALSE(HasPass("PixelChannels"));
	const FLightId Other = AddLamp(0, 2);
	Render();
	EXPECT_TRUE(HasPass("PixelChannels"));
	EXPECT_TRUE(HasPipeline("HAS_LIGHT_CHANNELS"));
	EXPECT_FALSE(HasBuffer("ObjectChannels")) << "all objects are of channel 0";
	GetWorld().RemoveLight(Other);
	GetWorld().RemoveLight(Lamp);
	Render();
	EXPECT_FALSE(HasPass("PixelChannels"));
	EXPECT_FALSE(GetWorld().GetFacts().bLightProfiles);
	EXPECT_FALSE(GetWorld().GetFacts().bLightChannels);
}

} // namespace
} // namespace Lantern
