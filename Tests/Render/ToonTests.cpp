// Objects of a stylised look: closed forms of each step, the reference, and that nothing else changes.
#include <cmath>

#include "Lights/PixelChannels.h"
#include "MotionFixture.h"
#include "SignalFixture.h"
#include "Toon/Toon.h"

namespace Lantern
{

namespace
{
/// As shaders have it: Library/Toon.glsl.
double SoftLimit(double X, double Limit)
{
	const double Knee = 0.2, Begin = (1.0 - Knee) * Limit;
	return X <= Begin ? X : Begin + Knee * Limit * (1.0 - std::exp((Begin - X) / (Knee * Limit)));
}

glm::dvec3 Grade(const FToonStyle& Style, const glm::dvec3& L, double Exposure)
{
	const double Value = std::max({L.x, L.y, L.z}), Saturation = 1.0 - std::min({L.x, L.y, L.z}) / Value;
	const double Limited = Style.MaxSaturation < 1.0f ? SoftLimit(Saturation, double(Style.MaxSaturation)) : Saturation;
	const double Shown = Style.MaxValue > 0.0f ? SoftLimit(Value * Exposure, double(Style.MaxValue)) / Exposure : Value;
	const glm::dvec3 Missing = Saturation > 0.0 ? (1.0 - L / Value) * (Limited / Saturation) : glm::dvec3(0);
	const glm::dvec3 Tint(Style.Tint);
	return Shown * (1.0 - Missing) * (Tint / glm::dot(Tint, glm::dvec3(0.2126, 0.7152, 0.0722)));
}

class FToonTest : public FSignalTest
{
protected:
	static constexpr uint32_t Size = 24;

	/// Two plates that face the camera and see the sky alone, or a ledge above as well. The left one has the style.
	void LoadPlates(const FToonStyle& Style, bool bLedge = false)
	{
		FTestScene Out("plates");
		const int32_t Grey = Out.AddLambert(glm::vec3(0.5f), glm::vec3(0), true);
		for (const float X : {-1.0f, 0.0f})
		{
			const int32_t Node = Out.AddNode(Out.AddMesh({{Grey, {{X, -1, 0}, {X + 1, -1, 0}, {X + 1, 1, 0}, {X, 1, 0}}}}));
			if (X < 0.0f) { Out.Scene.Nodes[static_cast<size_t>(Node)].Toon = Style; }
		}
		if (bLedge) { Out.AddNode(Out.AddMesh({{Grey, {{-1, 0.6f, 0}, {1, 0.6f, 0}, {1, 0.6f, 1}, {-1, 0.6f, 1}}}})); }
		ASSERT_TRUE(Load(std::move(Out.Scene)));
		SetSun(0.0, 0.0f);
		SetIndirect(1, 1);
		SetVariable("r.RT.GI.Denoise", "0");
		SetVariable("r.RT.Reflections", "0");
	}
	static FView SeePlates() { return LookAt({0, 0, 3}, {0, 0, 0}, 0.3f, Size, Size); }
	static glm::dvec3 At(const FImage& Picture, uint32_t X, uint32_t Y)
	{
		const float* const P = &Picture.Pixels[(size_t(Y) * Picture.Width + X) * Picture.Channels];
		return {P[0], P[1], P[2]};
	}
	static FReferenceSettings AtSurfaces(const FView& View, uint32_t Samples, uint32_t Bounces)
	{
		FReferenceSettings Settings;
		Settings.View = View;
		Settings.Signal = ESignal::DiffuseGI;
		Settings.Samples = Samples;
		Settings.Bounces = Bounces;
		Settings.bPixelCenters = Settings.bRasterSurfaces = true;
		return Settings;
	}
	static void ExpectColor(const char* What, const glm::dvec3& Is, const glm::dvec3& Expected)
	{
		EXPECT_LT(glm::length(Is - Expected), 1e-3 * glm::length(Expected))
		    << What << ": " << Is.x << " " << Is.y << " " << Is.z << ", expected " << Expected.x << " " << Expected.y << " " << Expected.z;
	}
};

// Under a uniform sky the light is the sky's radiance, and what objects show of it follows from the style alone.
TEST_F(FToonTest, LimitsAndTintFollowTheirFormula)
{
	FToonStyle Style;
	Style.Bend = 0.0f;
	Style.Tint = {1, 0.93f, 0.88f};
	ASSERT_NO_FATAL_FAILURE(LoadPlates(Style));
	for (const glm::vec3 Sky : {glm::vec3(1.0f, 0.25f, 0.1f), glm::vec3(0.1f, 0.11f, 0.12f), glm::vec3(0.02f, 3.0f, 2.0f)})
	{
		for (const float Stops : {0.0f, -2.0f})
		{
			SetSky(Sky);
			FView View = SeePlates();
			View.Exposure = Stops;
			const glm::dvec3 Expected = Grade(Style, Sky, std::exp2(Stops));
			const FImage Frame = RenderSignal(ESignal::DiffuseGI, View), Reference = TraceReference(AtSurfaces(View, 2, 1));
			ExpectColor("frame", At(Frame, 4, 12), Expected);
			ExpectColor("reference", At(Reference, 4, 12), Expected);
			ExpectColor("an object without a style", At(Frame, 20, 12), Sky);
			// The light of the sky that is not traced is graded as well.
			SetVariable("r.RT.GI", "0");
			SetVariable("r.RT.AO", "0");
			const FImage Ambient = RenderLighting(View);
			ExpectColor("ambient light", At(Ambient, 4, 12), At(Ambient, 20, 12) * Expected / glm::dvec3(Sky));
			EXPECT_GT(At(Ambient, 20, 12).x, 0.0);
			SetVariable("r.RT.GI", "1");
		}
	}
	// With the fault planted, the knee is gone.
	SetSky({0.75f, 0.7f, 0.65f});
	const glm::dvec3 Soft = At(RenderSignal(ESignal::DiffuseGI, SeePlates()), 4, 12);
	SetVariable("r.RT.Debug.GI.ToonKnee", "0");
	EXPECT_GT(At(RenderSignal(ESignal::DiffuseGI, SeePlates()), 4, 12).y, 1.03 * Soft.y) << "the planted fault goes unnoticed";
}

// Pixels of other objects have the bits of a scene without styles, and all have them if the styles are off.
TEST_F(FToonTest, OthersKeepTheirBits)
{
	FToonStyle Style;
	Style.SphereWeight = 1.0f;
	ASSERT_NO_FATAL_FAILURE(LoadPlates(Style));
	SetSky({0.3f, 0.5f, 0.9f});
	const FImage Styled = RenderSignal(ESignal::DiffuseGI, SeePlates());
	SetVariable("r.RT.GI.Toon", "0");
	const FImage Off = RenderSignal(ESignal::DiffuseGI, SeePlates());
	GetScene().GetScene().SetToon(GetScene().GetDraws()[0].Object, nullptr);
	const FImage Plain = RenderSignal(ESignal::DiffuseGI, SeePlates());
	EXPECT_EQ(FractionDiffering(Off, Plain, 0.0), 0.0);
	for (uint32_t Y = 0; Y < Size; ++Y)
	{
		for (uint32_t X = Size / 2; X < Size; ++X) { ASSERT_EQ(At(Styled, X, Y), At(Plain, X, Y)) << X << " " << Y; }
	}
	EXPECT_NE(At(Styled, 4, 12), At(Plain, 4, 12));
	// Paths that pixels share stop at the border, which changes the noise beside it.
	constexpr uint32_t Beside = 6;
	SetVariable("r.RT.GI", "3");
	const FImage PlainShared = RenderSignal(ESignal::DiffuseGI, SeePlates());
	GetScene().GetScene().SetToon(GetScene().GetDraws()[0].Object, std::make_shared<const FToonStyle>(Style));
	SetVariable("r.RT.GI.Toon", "1");
	const FImage StyledShared = RenderSignal(ESignal::DiffuseGI, SeePlates());
	EXPECT_NE(At(StyledShared, 4, 12), At(PlainShared, 4, 12));
	for (uint32_t Y = 0; Y < Size; ++Y)
	{
		for (uint32_t X = Size / 2 + Beside; X < Size; ++X) { ASSERT_EQ(At(StyledShared, X, Y), At(PlainShared, X, Y)) << X << " " << Y; }
	}
}

class FToonNumberTest : public FMotionTestBase
{};

// An engine's numbers name the styles that the raster's objects have. The channels of objects serve as numbers here.
TEST_F(FToonNumberTest, NumbersNameStylesAsObjectsDo)
{
	constexpr uint8_t Number = 4;
	FTestScene Out("numbers");
	const int32_t Grey = Out.AddLambert(glm::vec3(0.5f), glm::vec3(0), true);
	for (const float X : {-1.0f, 0.0f})
	{
		const int32_t Node = Out.AddNode(Out.AddMesh({{Grey, {{X, -1, 0}, {X + 1, -1, 0}, {X + 1, 1, 0}, {X, 1, 0}}}}));
		if (X < 0.0f) { Out.Scene.Nodes[static_cast<size_t>(Node)].Toon = FToonStyle{.SphereWeight = 0.5f, .Number = Number}; }
		if (X < 0.0f) { Out.Scene.Nodes[static_cast<size_t>(Node)].Traits.Channels = Number; }
	}
	ASSERT_TRUE(Load(std::move(Out.Scene)));
	SetSun(0.5);
	const FView View = MakeCamera({0, 0, 3}, {0, 0, 0});
	TRTRef<IRTBuffer> ByObject, ByNumber, Normals, NumberNormals;
	GetEngine().ExtraPasses = [&](FFrameContext& Context, const FGBuffer& GBuffer, const FFrameOutputs&) {
		FGBuffer Numbered = GBuffer;
		Numbered.ToonNumbers = RequirePixelChannels(Context, GBuffer);
		Numbered.bNamesObjects = false;
		(void)RequireToonSurface(Context, GBuffer);
		Read(Context, Context.Toon.Pixels, ByObject);
		Read(Context, Context.Toon.Normals, Normals);
		Context.Toon = {};
		(void)RequireToonSurface(Context, Numbered);
		Read(Context, Context.Toon.Pixels, ByNumber);
		Read(Context, Context.Toon.Normals, NumberNormals);
	};
	EXPECT_OK(GetEngine().RenderFrame(View, 0.0, {}, nullptr));
	EXPECT_OK(GetEngine().GetRenderer().WaitForAll());
	GetEngine().ExtraPasses = {};
	const std::vector<glm::vec2> Objects = Take<glm::vec2>(ByObject.Get(), View), Numbers = Take<glm::vec2>(ByNumber.Get(), View);
	EXPECT_EQ(Objects, Numbers);
	EXPECT_EQ(Take<glm::u16vec4>(Normals.Get(), View), Take<glm::u16vec4>(NumberNormals.Get(), View));
	const size_t Row = size_t(Height / 2) * Width;
	EXPECT_EQ(Numbers[Row + Width / 2 - 8], glm::vec2(0.5f, 1.0f));
	EXPECT_EQ(Numbers[Row + Width / 2 + 8], glm::vec2(0)) << "channel 0 is no style's number";
}

/// A cube over a wide floor that shines with 1, in a dark world: about any normal N, its light is (1 - N.y) / 2.
class FToonSphereTest : public FToonTest
{
protected:
	void LoadCube(const FToonStyle& Style, bool bHat = false)
	{
		FTestScene Out("cube");
		const int32_t Black = Out.AddLambert(glm::vec3(0), glm::vec3(0), true), Glow = Out.AddLambert(glm::vec3(0), glm::vec3(1), true);
		const auto AddBox = [&](glm::vec3 Low, glm::vec3 High) {
			std::vector<FTestScene::FQuad> Quads;
			for (int Axis = 0; Axis < 3; ++Axis)
			{
				for (const bool bHigh : {false, true})
				{
					FTestScene::FQuad Quad{Black, {}};
					for (int Corner = 0; Corner < 4; ++Corner)
					{
						glm::vec3& P = Quad.P[Corner];
						P[Axis] = bHigh ? High[Axis] : Low[Axis];
						P[(Axis + 1) % 3] = Corner == 1 || Corner == 2 ? High[(Axis + 1) % 3] : Low[(Axis + 1) % 3];
						P[(Axis + 2) % 3] = Corner >= 2 ? High[(Axis + 2) % 3] : Low[(Axis + 2) % 3];
					}
					if (!bHigh) { std::swap(Quad.P[1], Quad.P[3]); }
					Quads.push_back(Quad);
				}
			}
			const int32_t Node = Out.AddNode(Out.AddMesh(Quads), glm::translate(glm::dmat4(1), glm::dvec3(Place)));
			Out.Scene.Nodes[static_cast<size_t>(Node)].Toon = Style;
		};
		Out.AddNode(Out.AddMesh({FTestScene::MakeFloor(Glow, 4000.0f)}));
		AddBox(glm::vec3(-0.5f), glm::vec3(0.5f));
		if (bHat) { AddBox({-2, -0.7f, -2}, {2, -0.6f, 2}); } // between the cube and what shines
		ASSERT_TRUE(Load(std::move(Out.Scene)));
		SetSun(0.0, 0.0f);
		SetSky({});
		SetVariable("r.RT.Lights.Emissive", "0");
		SetVariable("r.RT.GI.Denoise", "0");
		SetVariable("r.RT.Reflections", "0");
	}
	static FToonStyle Plain(float SphereWeight, float Bend)
	{
		FToonStyle Style;
		Style.SphereWeight = SphereWeight;
		Style.Bend = Bend;
		Style.MaxSaturation = 1.0f;
		Style.MaxValue = 0.0f;
		return Style;
	}
	static FView See() { return LookAt(glm::dvec3(Place) + glm::dvec3(0.6, 1.2, 3.0), Place, 0.4f, Size, Size); }
	/// Largest error over the cube's pixels of what Expect says of a normal.
	template <class TExpect>
	static double FindError(const FImage& Picture, const FView& View, TExpect&& Expect, double& OutMean)
	{
		double Largest = 0.0, Sum = 0.0;
		uint32_t Count = 0;
		for (uint32_t Y = 0; Y < Size; ++Y)
		{
			for (uint32_t X = 0; X < Size; ++X)
			{
				const std::optional<glm::dvec3> OnCube = FindCube(View, X, Y);
				if (!OnCube || glm::dot(*OnCube, View.Position - glm::dvec3(Place) - *OnCube) < 0.1)
				{
					continue;
				} // it is bent to the camera
				const double Error = At(Picture, X, Y).y - Expect(*OnCube);
				Largest = std::max(Largest, std::abs(Error));
				Sum += Error;
				++Count;
			}
		}
		OutMean = Sum / std::max(Count, 1u);
		EXPECT_GT(Count, 40u);
		return Largest;
	}
	/// Where a camera ray meets the cube, relative to its centre.
	static std::optional<glm::dvec3> FindCube(const FView& View, uint32_t X, uint32_t Y)
	{
		const double Half = std::tan(0.5 * double(View.FovY));
		const glm::dvec3 Forward(View.Forward), Right = glm::normalize(glm::cross(Forward, glm::dvec3(View.Up))),
		                                        Up = glm::cross(Right, Forward);
		const glm::dvec2 OnScreen = (glm::dvec2(X, Y) + 0.5) / double(Size) * 2.0 - 1.0;
		const glm::dvec3 Direction = Forward + Half * (OnScreen.x * Right - OnScreen.y * Up);
		const glm::dvec3 From = View.Position - glm::dvec3(Place);
		double Near = 0.0, Far = 1e9;
		for (int Axis = 0; Axis < 3; ++Axis)
		{
			double A = (-0.5 - From[Axis]) / Direction[Axis], B = (0.5 - From[Axis]) / Direction[Axis];
			if (A > B) { std::swap(A, B); }
			Near = std::max(Near, A);
			Far = std::min(Far, B);
		}
		return Near < Far ? std::optional(From + Near * Direction) : std::nullopt;
	}
	static constexpr glm::vec3 Place{5, 3, -2};
};

TEST_F(FToonSphereTest, LightFallsAsOnASphere)
{
	ASSERT_NO_FATAL_FAILURE(LoadCube(Plain(1.0f, 0.0f)));
	SetIndirect(64, 1);
	const auto OnSphere = [](const glm::dvec3& P) { return 0.5 * (1.0 - glm::normalize(P).y); };
	const FView View = See();
	double Mean = 0.0;
	const double Error = FindError(RenderSignal(ESignal::DiffuseGI, View, 16), View, OnSphere, Mean);
	PrintFigure(fmt::format("light on a sphere: mean error {:.5f}, largest {:.4f}", Mean, Error));
	EXPECT_LT(std::abs(Mean), 0.002);
	EXPECT_LT(Error, 0.05) << "1,024 paths scatter by 0.015";
	double OfReference = 0.0;
	FindError(TraceReference(AtSurfaces(View, 1024, 1)), View, OnSphere, OfReference);
	EXPECT_LT(std::abs(OfReference), 0.002);
	SetVariable("r.RT.GI.Toon", "0");
	EXPECT_GT(FindError(RenderSignal(ESignal::DiffuseGI, View, 16), View, OnSphere, Mean), 0.2) << "a cube's own normals are others";
}

// Other objects with a sphere, such as hair, hide no light from it.
TEST_F(FToonSphereTest, SpheresHideNoLightFromEachOther)
{
	ASSERT_NO_FATAL_FAILURE(LoadCube(Plain(1.0f, 0.0f), true));
	SetIndirect(64, 1);
	double Mean = 0.0;
	const FView View = See();
	const auto OnSphere = [](const glm::dvec3& P) { return 0.5 * (1.0 - glm::normalize(P).y); };
	FindError(RenderSignal(ESignal::DiffuseGI, View, 16), View, OnSphere, Mean);
	EXPECT_LT(std::abs(Mean), 0.002);
	GetScene().GetScene().SetToon(GetScene().GetDraws()[2].Object, nullptr);
	FindError(RenderSignal(ESignal::DiffuseGI, View, 16), View, OnSphere, Mean);
	EXPECT_LT(Mean, -0.1) << "what has no sphere hides it";
}

// A normal that turns away from its surface loses no light: in a furnace all normals have the same.
TEST_F(FToonSphereTest, BentNormalsLoseNoLight)
{
	for (const float Bend : {0.35f, 1.0f})
	{
		ASSERT_NO_FATAL_FAILURE(LoadCube(Plain(0.0f, Bend)));
		SetSky(glm::vec3(1));
		SetIndirect(64, 1);
		double Mean = 0.0;
		const FView View = See();
		FindError(
		    RenderSignal(ESignal::DiffuseGI, View, 16), View, [](const glm::dvec3&) { return 1.0; }, Mean);
		PrintFigure(fmt::format("furnace, bent by {}: mean error {:.5f}", Bend, Mean));
		EXPECT_LT(std::abs(Mean), 0.002);
	}
}

// The figures of the built-in scene, lit over several bounces: frames agree with the reference. Limits are no linear map of noise, and stay off.
TEST_F(FToonTest, FiguresAsTheReference)
{
	ASSERT_TRUE(Load("toon"));
	FHostScene& Host = GetScene();
	FRTScene& World = Host.GetScene();
	for (const auto& Draw : Host.GetDraws())
	{
		const auto& Given = World.GetObject(Draw.Object).Toon;
		if (!Given) { continue; }
		FToonStyle Style = *Given;
		Style.MaxSaturation = 1.0f;
		Style.MaxValue = 0.0f;
		World.SetToon(Draw.Object, std::make_shared<const FToonStyle>(Style));
	}
	SetIndirect(16, 3);
	SetVariable("r.RT.GI.Denoise", "0");
	SetVariable("r.RT.Reflections", "0");
	const FView View = MakeView(64, 40);
	std::vector<double> Ours, Theirs;
	for (uint32_t Batch = 0; Batch < 4; ++Batch)
	{
		FView Seeded = View;
		Seeded.Seed = 1 + Batch;
		Ours.push_back(ComputeMeans(RenderSignal(ESignal::DiffuseGI, Seeded, 12)).Luminance);
		Theirs.push_back(ComputeMeans(TraceReference(AtSurfaces(Seeded, 192, 4))).Luminance);
	}
	ExpectClosedForm("figures over the reference", MakeEstimate(Ours), MakeEstimate(Theirs).Mean, 0.02);
}

// Occlusion darkens the light of the style's objects by the signal of ambient occlusion, and nothing else.
TEST_F(FToonTest, OcclusionIsALayer)
{
	FToonStyle Style;
	Style.MaxSaturation = 1.0f;
	Style.MaxValue = 0.0f;
	ASSERT_NO_FATAL_FAILURE(LoadPlates(Style, true));
	SetSky(glm::vec3(1));
	SetVariable("r.RT.AO.Denoise", "0");
	SetVariable("r.RT.AO.Samples", "16");
	SetIndirect(64, 1);
	const FImage Without = RenderLighting(SeePlates());
	Style.Occlusion = 0.75f;
	GetScene().GetScene().SetToon(GetScene().GetDraws()[0].Object, std::make_shared<const FToonStyle>(Style));
	const FImage Visibility = RenderSignal(ESignal::AmbientOcclusion, SeePlates());
	const FImage With = RenderLighting(SeePlates());
	EXPECT_LT(ComputeMeans(Visibility).Luminance, 0.9) << "the ledge hides some of the sky";
	glm::dvec2 Light(0), LightBefore(0); // of the plate with the style, of the other one
	double Seen = 0.0;
	for (uint32_t Y = 0; Y < Size; ++Y)
	{
		for (uint32_t X = 0; X < Size; ++X)
		{
			const int Plate = X < Size / 2 ? 0 : 1;
			Light[Plate] += At(With, X, Y).y;
			LightBefore[Plate] += At(Without, X, Y).y;
			Seen += Plate == 0 ? double(Visibility.Pixels[size_t(Y) * Size + X]) : 0.0;
		}
	}
	const glm::dvec2 Left = Light / LightBefore;
	const double Expected = 1.0 - 0.75 * (1.0 - 2.0 * Seen / (Size * Size));
	PrintFigure(
	    fmt::format("layer of occlusion: {:.4f} of the light is left, expected {:.4f}; beside it {:.4f}", Left.x, Expected, Left.y));
	EXPECT_NEAR(Left.x, Expected, 0.02) << "18,432 paths and 4,608 rays scatter by less than 0.5 %";
	EXPECT_NEAR(Left.y, 1.0, 0.01);
}

} // namespace
} // namespace Lantern
