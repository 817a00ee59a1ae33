// Lamps with a profile: what a plane receives against the closed form E = I(angle) cos³ / h², and signals against the reference.
#include <array>
#include <cmath>

#include <glm/gtc/matrix_transform.hpp>

#include "LanternScene/Lights/Photometry.h"
#include "SignalFixture.h"
#include "Support/IesText.h"
#include "Support/Srgb.h"

namespace Lantern
{

namespace
{
constexpr double Tolerance = 0.005;
constexpr double Height = 2.0, Peak = 40.0; // metres, candela
const float Albedo = MakeSrgb(190);

/// Without symmetry, and equal to no mirror image of itself. Its peak is 1, below the lamp.
double ShapeAt(double Horizontal, double Vertical)
{
	const double H = glm::radians(Horizontal), V = glm::radians(Vertical);
	return std::pow(std::cos(V), 2.0) * (1.0 - std::sin(V) * (0.5 + 0.2 * std::cos(H) + 0.3 * std::sin(H)));
}

FProfileGrid MakeGrid(const std::string& Text)
{
	FPhotometry Table;
	EXPECT_OK(ParseIes(Text, "lamp.ies", Table));
	return MakeProfileGrid(Table);
}

class FLightProfileTest : public FSignalTest
{
protected:
	void SetUp() override
	{
		FSignalTest::SetUp();
		SetVariable("r.RT.Lights.Denoise", "0");
		FTestScene Scene("profiles");
		const int32_t Grey = Scene.AddLambert(glm::vec3(Albedo), glm::vec3(0), true);
		Scene.AddNode(Scene.AddMesh({FTestScene::MakeFloor(Grey, 20.0f)}));
		// Posts cast shadows, away from where the closed form looks.
		Scene.AddNode(Scene.AddMesh({{Grey, {{-0.3f, 0, -6}, {0.3f, 0, -6}, {0.3f, 1.2f, -6}, {-0.3f, 1.2f, -6}}}}));
		// Above the lamp, and away from all else: what a file of the lower half leaves dark.
		Scene.AddNode(Scene.AddMesh({FTestScene::MakeFloor(Grey, 1.0f, Height + 1.0f, {6, 6})}));
		ASSERT_TRUE(Load(std::move(Scene.Scene)));
		SetSky(glm::vec3(0));
		SetSun(0.0, 1.0f, {0, -1, 0});
		AlbedoSeen = MeanGreen(RenderLighting(MakePointView({}))) * Pi;
		SetSun(0.0, 0.0f);
	}
	static FRTScene& GetWorld() { return GetScene().GetScene(); }
	static FView MakePointView(glm::dvec2 At) { return LookAt({At.x, 6, At.y}, {At.x, 0, At.y}, 0.0002f, 8, 8); }
	static FSceneLight MakeLamp(uint32_t Profile)
	{
		FSceneLight Light;
		Light.Position = {0, Height, 0};
		Light.Color = glm::vec3(float(Peak));
		Light.Profile = Profile;
		return Light;
	}
	/// Holds all ways to light against the closed form. The lamp shines down, with its horizontal angle 0 along x, and 90 along −z.
	void ExpectPlane(glm::dvec2 At)
	{
		const double Far = glm::length(At), Vertical = std::atan2(Far, Height);
		double Horizontal = glm::degrees(std::atan2(-At.y, At.x));
		if (Horizontal < 0.0) { Horizontal += 360.0; }
		const double Expected = Peak * ShapeAt(Horizontal, glm::degrees(Vertical)) * std::pow(std::cos(Vertical), 3.0) / (Height * Height);
		const FView View = MakePointView(At);
		const std::string Where = fmt::format("profile, ({}, {}) m", At.x, At.y);
		const double Traced = MeanGreen(TraceReference(View, 1, 1)) * Pi / double(Albedo);
		const double Lit = MeanGreen(RenderLighting(View)) * Pi / AlbedoSeen;
		const double Signal = MeanGreen(RenderSignal(ESignal::LocalDiffuse, View)) * Pi;
		PrintFigure(fmt::format("{}: {:.5f} lx; reference {:+.3f} %, lighting {:+.3f} %, signal {:+.3f} %", Where, Expected,
		    100.0 * (Traced / Expected - 1.0), 100.0 * (Lit / Expected - 1.0), 100.0 * (Signal / Expected - 1.0)));
		EXPECT_NEAR(Traced / Expected, 1.0, Tolerance) << Where;
		EXPECT_NEAR(Lit / Expected, 1.0, Tolerance) << Where;
		EXPECT_NEAR(Signal / Expected, 1.0, Tolerance) << Where;
	}

	double AlbedoSeen = 0.0; // by direct lighting
};

constexpr double Diagonal = 1.2;
const glm::dvec2 Places[] = {{0, 0}, {1, 0}, {0, 1.5}, {0, -1.5}, {-2, 0}, {Diagonal, Diagonal}, {-Diagonal, 3}, {3, -Diagonal}};

TEST_F(FLightProfileTest, PlaneAsTheClosedForm)
{
	// All around, by degree and by five degrees.
	const FProfileGrid Grid = MakeGrid(MakeIesText(MakeAngles(0, 90, 1), MakeAngles(0, 360, 5), ShapeAt));
	EXPECT_EQ(Grid.Columns, 72u);
	(void)GetWorld().AddLight(MakeLamp(GetWorld().AddLightProfile(Grid)));
	for (const glm::dvec2& At : Places) { ExpectPlane(At); }
	// Above the horizon the file has nothing.
	const FView Ceiling = LookAt({6, 2.5, 6}, {6, Height + 1.0, 6}, 0.0002f, 8, 8);
	const auto LightCeiling = [&] {
		return std::array{MeanGreen(TraceReference(Ceiling, 1, 1)), MeanGreen(RenderLighting(Ceiling)),
		    MeanGreen(RenderSignal(ESignal::LocalDiffuse, Ceiling))};
	};
	EXPECT_EQ(LightCeiling(), (std::array{0.0, 0.0, 0.0}));
	SetVariable("r.RT.Debug.Lights.Profile", "0");
	for (const double Lit : LightCeiling()) { EXPECT_GT(Lit, 0.0) << "the test could not fail"; }
}

// With the fault planted, the lamp shines alike in all directions.
TEST_F(FLightProfileTest, LampWithoutItsProfileIsSeen)
{
	const FProfileGrid Grid = MakeGrid(MakeIesText(MakeAngles(0, 90, 1), MakeAngles(0, 360, 5), ShapeAt));
	(void)GetWorld().AddLight(MakeLamp(GetWorld().AddLightProfile(Grid)));
	SetVariable("r.RT.Debug.Lights.Profile", "0");
	const double Expected = Peak * ShapeAt(0.0, 45.0) * std::pow(0.5, 1.5) / (Height * Height);
	EXPECT_GT(MeanGreen(TraceReference(MakePointView({Height, 0}), 1, 1)) * Pi / double(Albedo), 1.1 * Expected);
	EXPECT_GT(MeanGreen(RenderLighting(MakePointView({Height, 0}))) * Pi / AlbedoSeen, 1.1 * Expected);
	EXPECT_GT(MeanGreen(RenderSignal(ESignal::LocalDiffuse, MakePointView({Height, 0}))) * Pi, 1.1 * Expected);
}

// A lamp that is tilted turns its profile; the tangent says where horizontal angles begin.
TEST_F(FLightProfileTest, AxesTurnTheProfile)
{
	const FProfileGrid Grid = MakeGrid(MakeIesText(MakeAngles(0, 180, 1), MakeAngles(0, 360, 5), ShapeAt));
	FSceneLight Lamp = MakeLamp(GetWorld().AddLightProfile(Grid));
	Lamp.Direction = glm::normalize(glm::vec3(1, -1, 0));
	Lamp.Tangent = {0, 0, 1};
	(void)GetWorld().AddLight(Lamp);
	// On the axis: vertical angle 0.
	const double OnAxis = Peak * std::pow(0.5, 1.5) / (Height * Height);
	EXPECT_NEAR(MeanGreen(RenderSignal(ESignal::LocalDiffuse, MakePointView({Height, 0}))) * Pi / OnAxis, 1.0, Tolerance);
	// Below the lamp, 45° from the axis: against (1, -1, 0) × … the direction is −(1, 1, 0)/√2, a quarter turn from z.
	const glm::dvec3 Axis = glm::normalize(glm::dvec3(1, -1, 0)), Up = -Axis, Zero(0, 0, 1), Quarter = glm::cross(Up, Zero);
	const glm::dvec3 Down(0, -1, 0);
	double Turn = glm::degrees(std::atan2(glm::dot(Down, Quarter), glm::dot(Down, Zero)));
	Turn += Turn < 0.0 ? 360.0 : 0.0;
	const double Below = Peak * ShapeAt(Turn, 45.0) / (Height * Height);
	EXPECT_NEAR(MeanGreen(RenderSignal(ESignal::LocalDiffuse, MakePointView({0, 0}))) * Pi / Below, 1.0, Tolerance);
	EXPECT_NEAR(MeanGreen(TraceReference(MakePointView({0, 0}), 1, 1)) * Pi / double(Albedo) / Below, 1.0, Tolerance);
}

// Few lights and many, with and without profiles: weights by which pixels choose lights never miss what a profile lets through.
TEST_F(FLightProfileTest, FewAndManyAsTheReference)
{
	const uint32_t Wide = GetWorld().AddLightProfile(MakeGrid(MakeIesText(MakeAngles(0, 90, 1), MakeAngles(0, 360, 5), ShapeAt)));
	const auto Narrow = [](double, double V) { return std::exp(-std::pow(V / 12.0, 2.0)) + (V > 50.0 && V < 60.0 ? 0.3 : 0.0); };
	const uint32_t Beam = GetWorld().AddLightProfile(MakeGrid(MakeIesText(MakeAngles(0, 90, 0.5), {0}, Narrow)));
	const FView View = LookAt({0, 3.0, 0.5}, {0, 0.2, -4.5}, 0.9f, 48, 27);
	std::vector<FLightId> Ids;
	for (const uint32_t Count : {3u, 24u, 160u})
	{
		while (Ids.size() < Count)
		{
			const double I = static_cast<double>(Ids.size()), Far = 2.6 * std::sqrt((I + 0.5) / Count);
			FSceneLight Light = MakeLamp(Ids.size() % 3 == 0 ? Wide : Ids.size() % 3 == 1 ? Beam : 0);
			Light.Position = {Far * std::cos(2.4 * I), 1.0 + 0.1 * static_cast<double>(Ids.size() % 9), -4.5 + Far * std::sin(2.4 * I)};
			Light.Direction = {0.3f * float(Ids.size() % 4) - 0.4f, -1.0f, 0.2f};
			Ids.push_back(GetWorld().AddLight(Light));
		}
		ExpectUnbiased(fmt::format("{} lamps with profiles", Count).c_str(), ESignal::LocalDiffuse, View, Count > 4 ? 192 : 16,
		    Count > 4 ? 512 : 96, 1, 0.005);
	}
}

} // namespace
} // namespace Lantern
