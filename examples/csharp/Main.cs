// SPDX-License-Identifier: MIT
// A pile of soft bodies of two materials, made and watched in C#.
using Godot;
using SoftBodies;

public partial class Main : Node2D
{
	private const int Rows = 4;
	private const int Columns = 5;

	private SoftBody2D _first;
	private double _hardest;

	public override void _Ready()
	{
		// A node of the scene, which C# knows as a Node2D.
		_first = SoftBody2D.From(GetNode("Jelly"));
		_first.ContactMonitor = true;
		_first.ContactStarted += OnContactStarted;

		SoftBodyMaterial2D rubber = SoftBodyMaterial2D.MakePreset(SoftBodyMaterial2D.PresetEnum.Rubber);
		for (int i = 0; i < Rows * Columns; i++)
		{
			var body = new SoftBody2D();
			body.Polygon = SoftBody2D.MakeCirclePolygon(30, 16);
			body.SoftBodyMaterial = i % 2 == 0 ? rubber : null;
			body.Color = new Color(0.2f + 0.15f * (i % Columns), 0.6f, 0.9f);
			body.Node.Position = new Vector2(250 + 80 * (i % Columns), 100 - 80 * (i / Columns));
			AddChild(body);
		}
	}

	public override void _PhysicsProcess(double delta)
	{
		if (_first.Sleeping)
		{
			GD.Print("At rest: ", SoftBodySimulation2D.GetAwakeBodyCount(), " bodies are awake, the hardest blow was ", _hardest, " kg px/s.");
			_first.ApplyCentralImpulse(Vector2.Up * 500);
		}
	}

	private void OnContactStarted(Node body, Vector2 point, Vector2 normal, double impulse)
	{
		if (impulse > _hardest)
		{
			_hardest = impulse;
		}
	}
}
