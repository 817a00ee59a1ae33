// Where curved mirrors showed in the frame before what they show now: against the specular points of spheres, in double precision.
#include <algorithm>
#include <cmath>
#include <vector>

#include "LanternHost/VertexPacking.h"
#include "SignalFixture.h"

namespace Lantern
{

namespace
{
constexpr double RoomHalf = 14.0; // metres

/// What moves from the frame before to this one.
struct FSphereCase
{
	double Radius = 1.0;
	glm::dvec3 Camera{0}, Sphere{0}, Room{0}; ///< metres
};

struct FSphereErrors
{
	size_t Mirrors = 0, Refused = 0;
	std::vector<double> Pixels; ///< ascending, of those that were found

	double At(double Share) const
	{
		return Pixels.empty() ? 0.0 : Pixels[std::min(Pixels.size() - 1, size_t(Share * double(Pixels.size())))];
	}
	double GetRefusedShare() const { return double(Refused) / double(std::max<size_t>(Mirrors, 1)); }
};

class FCurvedMirrorTest : public FSignalTest
{
protected:
	static constexpr uint32_t Width = 320, Height = 200;

	/// A sphere with a mirror's surface about the origin, closer to a true one than a pixel of these pictures shows.
	static FHostMesh MakeSphere(int32_t Material, double Radius)
	{
		constexpr uint32_t Around = 512, Rows = 256;
		FHostMesh Mesh;
		Mesh.Name = "sphere";
		Mesh.BoundsMin = glm::vec3(float(-Radius));
		Mesh.BoundsMax = glm::vec3(float(Radius));
		for (uint32_t Row = 0; Row <= Rows; ++Row)
		{
			for (uint32_t Column = 0; Column <= Around; ++Column)
			{
				const double Theta = Pi * Row / Rows, Phi = 2.0 * Pi * Column / Around;
				const glm::dvec3 Normal(std::sin(Theta) * std::cos(Phi), std::cos(Theta), std::sin(Theta) * std::sin(Phi));
				FVertexAttributes Vertex{};
				Vertex.Normal = PackUnitVector(Normal);
				Vertex.Color = PackColor(glm::vec4(1));
				Mesh.Positions.emplace_back(Radius * Normal);
				Mesh.Attributes.push_back(Vertex);
				if (Row == Rows || Column == Around) { continue; }
				const uint32_t A = Row * (Around + 1) + Column, B = A + Around + 1;
				for (const uint32_t Index : {A, A + 1, B, A + 1, B + 1, B}) { Mesh.Indices.push_back(Index); }
			}
		}
		Mesh.Sections.push_back({0, static_cast<uint32_t>(Mesh.Indices.size()), Material});
		return Mesh;
	}

	[[nodiscard]] bool LoadSphere(const FSphereCase& Case)
	{
		FTestScene Scene("sphere mirror");
		FHostMaterial Silver;
		Silver.Roughness = 0.0f;
		Silver.bDoubleSided = true;
		const int32_t Mirror = Scene.AddMaterial(Silver), Wall = Scene.AddLambert(glm::vec3(0.5f), glm::vec3(0), true);
		const auto H = float(RoomHalf);
		std::vector<FTestScene::FQuad> Walls;
		for (int Axis = 0; Axis < 3; ++Axis)
		{
			for (const float Side : {-H, H})
			{
				glm::vec3 P[4];
				for (int Corner = 0; Corner < 4; ++Corner)
				{
					P[Corner][Axis] = Side;
					P[Corner][(Axis + 1) % 3] = Corner == 1 || Corner == 2 ? H : -H;
					P[Corner][(Axis + 2) % 3] = Corner >= 2 ? H : -H;
				}
				Walls.push_back({Wall, {P[0], P[1], P[2], P[3]}});
			}
		}
		FHostAnimation Motion{.Name = "Motion", .Channels = {}, .Duration = 2.0f};
		const auto Move = [&](int32_t Node, const glm::dvec3& Way) {
			Scene.Scene.Nodes[static_cast<size_t>(Node)].Matrix.reset();
			Motion.Channels.push_back(
			    {.Node = Node, .Times = {0.0f, 1.0f, 2.0f}, .Values = {glm::vec4(glm::vec3(-Way), 0), glm::vec4(0), glm::vec4(0)}});
		};
		Move(Scene.AddNode(Scene.AddMesh(Walls)), Case.Room);
		Scene.Scene.Meshes.push_back(MakeSphere(Mirror, Case.Radius));
		Move(Scene.AddNode(static_cast<int32_t>(Scene.Scene.Meshes.size()) - 1), Case.Sphere);
		Scene.Scene.Animations.push_back(Motion);
		if (!Load(std::move(Scene.Scene))) { return false; }
		SetSky(glm::vec3(0.5f)); // without light there are no reflections
		return true;
	}

	static glm::dvec3 GetCamera(const FSphereCase& Case) { return {0.1 * Case.Radius, 0.4 * Case.Radius, 1.6 * Case.Radius + 0.3}; }
	/// bBefore: in the frame before.
	static FView Look(const FSphereCase& Case, bool bBefore)
	{
		const glm::dvec3 Position = GetCamera(Case) - (bBefore ? Case.Camera : glm::dvec3(0));
		FView View = LookAt(Position, Position + glm::dvec3(0, -0.2, -1), 0.9f, Width, Height);
		View.bCut = bBefore;
		return View;
	}

	static glm::dmat3 GetAxes(const FView& View) // right, down, forward
	{
		const glm::dvec3 Forward = glm::normalize(glm::dvec3(View.Forward)),
		                 Right = glm::normalize(glm::cross(Forward, glm::dvec3(View.Up)));
		return {Right, glm::cross(Forward, Right), Forward};
	}
	static glm::dvec2 Project(const FView& View, const glm::dvec3& Point)
	{
		const glm::dvec3 P = glm::transpose(GetAxes(View)) * (Point - View.Position);
		return glm::dvec2(P) / (P.z * View.GetPixelSize()) + 0.5 * glm::dvec2(Width, Height);
	}

	/// The point of the sphere in which From sees To, near Start. Newton's method on its two angles.
	static glm::dvec3 FindSpecularPoint(
	    const glm::dvec3& Center, double Radius, const glm::dvec3& From, const glm::dvec3& To, glm::dvec3 Normal)
	{
		for (int Step = 0; Step < 30; ++Step)
		{
			const glm::dvec3 U = glm::normalize(glm::cross(Normal, std::abs(Normal.x) < 0.7 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0))),
			                 V = glm::cross(Normal, U);
			const auto Miss = [&](double A, double B) {
				const glm::dvec3 N = glm::normalize(Normal + A * U + B * V), P = Center + Radius * N;
				const glm::dvec3 M = glm::normalize(glm::normalize(From - P) + glm::normalize(To - P));
				return glm::dvec2(glm::dot(M - N, U), glm::dot(M - N, V));
			};
			constexpr double Small = 1e-5;
			const glm::dvec2 At = Miss(0, 0), Du = (Miss(Small, 0) - Miss(-Small, 0)) / (2 * Small),
			                 Dv = (Miss(0, Small) - Miss(0, -Small)) / (2 * Small);
			const glm::dvec2 Move = -(glm::inverse(glm::dmat2(Du, Dv)) * At);
			Normal = glm::normalize(Normal + Move.x * U + Move.y * V);
		}
		return Center + Radius * Normal;
	}

	/// By how much the picture of the motion is off.
	static FSphereErrors Measure(const FSphereCase& Case, const FImage& Picture)
	{
		const FView Now = Look(Case, false), Before = Look(Case, true);
		const glm::dmat3 Axes = GetAxes(Now);
		FSphereErrors Errors;
		for (uint32_t Y = 0; Y < Height; ++Y)
		{
			for (uint32_t X = 0; X < Width; ++X)
			{
				const glm::dvec2 Pixel(X + 0.5, Y + 0.5), Plane = (Pixel - 0.5 * glm::dvec2(Width, Height)) * Now.GetPixelSize();
				const glm::dvec3 Ray = glm::normalize(Axes * glm::dvec3(Plane, 1.0)), Origin = Now.Position;
				const double B = glm::dot(Origin, Ray), C = glm::dot(Origin, Origin) - Case.Radius * Case.Radius, Root = B * B - C;
				const float* Texel = &Picture.Pixels[3 * (size_t(Y) * Width + X)];
				const bool bBlack = Texel[0] == 0.0f && Texel[1] == 0.0f && Texel[2] == 0.0f;
				// No mirror, or the edge of one.
				if (Root <= 0.0 || (bBlack && Root < 0.05 * Case.Radius * Case.Radius)) { continue; }
				++Errors.Mirrors;
				if (bBlack || Texel[2] > 0.5f)
				{
					++Errors.Refused;
					continue;
				}
				const glm::dvec3 Place = Origin + (-B - std::sqrt(Root)) * Ray, Normal = Place / Case.Radius,
				                 Away = glm::reflect(Ray, Normal);
				double T = 1e9;
				for (int Axis = 0; Axis < 3; ++Axis)
				{
					T = std::min(T, ((Away[Axis] > 0.0 ? RoomHalf : -RoomHalf) - Place[Axis]) / Away[Axis]);
				}
				const glm::dvec3 Was = FindSpecularPoint(-Case.Sphere, Case.Radius, Before.Position, Place + T * Away - Case.Room, Normal);
				const glm::dvec2 Motion = Project(Before, Was) - Pixel, Shown = (glm::dvec2(Texel[0], Texel[1]) * 255.0 - 128.0) / 8.0;
				Errors.Pixels.push_back(glm::length(Motion - Shown));
			}
		}
		std::sort(Errors.Pixels.begin(), Errors.Pixels.end());
		return Errors;
	}

	static FSphereErrors Render(const FSphereCase& Case)
	{
		FFrameCapture Capture;
		Capture.bDisplay = true;
		Capture.Signals.Add(ESignal::Reflections);
		FCapturedFrame Frame;
		for (const bool bBefore : {true, false})
		{
			const FRTStatus Status = GetEngine().RenderFrame(Look(Case, bBefore), bBefore ? 0.0 : 1.0, Capture, &Frame);
			EXPECT_TRUE(Status) << Status.Message;
		}
		return Measure(Case, Frame.Display);
	}
};

// At most half a pixel off, with the rounding of the picture, or refused.
TEST_F(FCurvedMirrorTest, FollowsWhatMovesToAPixel)
{
	SetVariable("r.RT.GI", "0");
	SetVariable("r.RT.Reflections", "1");
	SetVariable("r.RT.Debug.View", "reflection_motion");
	const glm::dvec3 Still(0), Aside(0.05, 0.01, 0.0), Room(0.03, 0.0, -0.04), Sphere(-0.02, 0.01, 0.01);
	for (const FSphereCase& Case :
	    {FSphereCase{0.2, 0.3 * Aside, Still, Still}, FSphereCase{1.0, Aside, Still, Still}, FSphereCase{5.0, Aside, Still, Still},
	        FSphereCase{1.0, Still, Still, Room}, FSphereCase{1.0, Still, Sphere, Still}, FSphereCase{1.0, Aside, Sphere, Room}})
	{
		ASSERT_TRUE(LoadSphere(Case));
		const FSphereErrors Errors = Render(Case);
		PrintFigure(fmt::format("radius {}: {} pixels, {:.2f} % refused; error in pixels: half {:.3f}, 99.9 % {:.3f}, most {:.3f}",
		    Case.Radius, Errors.Mirrors, 100.0 * Errors.GetRefusedShare(), Errors.At(0.5), Errors.At(0.999), Errors.At(1.0)));
		EXPECT_GT(Errors.Mirrors, size_t(Width) * Height / 8);
		EXPECT_LT(Errors.GetRefusedShare(), 0.05);
		EXPECT_LT(Errors.At(0.999), 0.5);
	}
	const FSphereCase Case{1.0, Aside, Sphere, Room};
	SetVariable("r.RT.Debug.Reflections.Curvature", "0");
	const FSphereErrors Fault = Render(Case);
	PrintFigure(fmt::format("as if flat: half {:.3f}, 99.9 % {:.3f}", Fault.At(0.5), Fault.At(0.999)));
	EXPECT_GT(Fault.At(0.5), 1.0);
}
} // namespace

} // namespace Lantern
