// What precision is left far away from the world's origin, and from an object's own.
#include <cmath>

#include <glm/gtc/matrix_transform.hpp>

#include "LanternImage/ImageStatistics.h"
#include "SignalFixture.h"

namespace Lantern
{
namespace
{

/// As far from places for the scene's origin as it gets, and not on whole numbers.
constexpr glm::dvec3 Far(16'031.3, 500.7, -15'969.1);

class FFarFromOriginTest : public FSignalTest
{
protected:
	/// A plate Gap above a floor, the sun ten degrees above it, and a picture of the narrow shadow beside it.
	[[nodiscard]] bool LoadPlate(const glm::dvec3& Place, float Gap)
	{
		FTestScene Scene("plate");
		const int32_t Grey = Scene.AddLambert(glm::vec3(0.5f), glm::vec3(0), true);
		Scene.AddNode(Scene.AddMesh({FTestScene::MakeFloor(Grey, 2.0f)}), glm::translate(glm::dmat4(1.0), Place));
		const float H = Gap;
		Scene.AddNode(Scene.AddMesh({{Grey, {{-1, H, 1}, {0, H, 1}, {0, H, -1}, {-1, H, -1}}}}), glm::translate(glm::dmat4(1.0), Place));
		if (!Load(std::move(Scene.Scene))) { return false; }
		const double Elevation = glm::radians(10.0);
		SetSun(0.0, 4.0f, {std::cos(Elevation), -std::sin(Elevation), 0.0});
		return true;
	}
	static FView LookAtShadow(const glm::dvec3& Place)
	{
		FView View = LookAt({0.4, 1.2, 0.05}, {0.02, 0, 0}, 0.06f, 96, 54);
		View.Position += Place;
		return View;
	}
	static double CountDark(const FImage& Image)
	{
		double Dark = 0.0;
		for (uint32_t Pixel = 0; Pixel < Image.GetPixelCount(); ++Pixel)
		{
			Dark += Image.Pixels[size_t(Pixel) * Image.Channels] < 0.5f ? 1.0 : 0.0;
		}
		return Dark / double(Image.GetPixelCount());
	}
};

// Rays that leave the floor as high as the plate, or a good part of it, see little of its shadow or none.
TEST_F(FFarFromOriginTest, ContactsOfThreeMillimetresCastShadows)
{
	double Dark[2][2];
	for (const int Away : {0, 1})
	{
		const glm::dvec3 Place = double(Away) * Far;
		ASSERT_TRUE(LoadPlate(Place, 0.003f));
		Dark[Away][0] = CountDark(RenderSunShadow(LookAtShadow(Place)));
		Dark[Away][1] = CountDark(TraceSignal(ESignal::SunShadow, LookAtShadow(Place), 4));
	}
	PrintFigure(fmt::format(
	    "dark at the origin: frame {:.3f}, reference {:.3f}; 16 km away: {:.3f}, {:.3f}", Dark[0][0], Dark[0][1], Dark[1][0], Dark[1][1]));
	for (const int Reference : {0, 1})
	{
		EXPECT_GT(Dark[0][Reference], 0.1);
		EXPECT_GT(Dark[1][Reference], 0.7 * Dark[0][Reference]) << (Reference ? "reference" : "frame");
		EXPECT_LT(Dark[1][Reference], 1.05 * Dark[0][Reference]) << (Reference ? "reference" : "frame");
	}
}

// A driver turns rays into the object's space: what is lost there does not show in coordinates near the camera.
TEST_F(FFarFromOriginTest, SurfacesFarFromTheirPivotsAreNotInTheirOwnShadow)
{
	constexpr float Away = 20'000.0f;
	FTestScene Scene("pivot");
	const int32_t Grey = Scene.AddLambert(glm::vec3(0.5f), glm::vec3(0), true);
	std::vector<FTestScene::FQuad> Quads;
	for (int X = -4; X < 4; ++X)
	{
		for (int Z = -4; Z < 4; ++Z)
		{
			const float X0 = Away + float(X), Z0 = Away + float(Z);
			Quads.push_back({Grey, {{X0, 0, Z0 + 1}, {X0 + 1, 0, Z0 + 1}, {X0 + 1, 0, Z0}, {X0, 0, Z0}}});
		}
	}
	const glm::dmat4 Turn = glm::rotate(glm::dmat4(1.0), 0.4, glm::normalize(glm::dvec3(1, 0.7, 0.3)));
	const glm::dvec3 There(Turn * glm::dvec4(Away, 0, Away, 1)), Up(Turn[1]);
	Scene.AddNode(Scene.AddMesh(Quads), Turn);
	ASSERT_TRUE(Load(std::move(Scene.Scene)));
	SetSun(0.0, 4.0f, -Up - 0.8 * glm::dvec3(Turn[0]));
	const FView View = LookAt(There + 2.0 * Up + glm::dvec3(Turn[2]), There, 0.9f, 96, 54);
	EXPECT_LT(CountDark(RenderSunShadow(View)), 1e-3);
	EXPECT_LT(CountDark(TraceSignal(ESignal::SunShadow, View, 4)), 1e-3);
}

} // namespace
} // namespace Lantern
