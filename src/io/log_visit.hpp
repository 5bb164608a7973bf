#pragma once

#include "kestrel/io/run_log.hpp"

/// The columns of the run log, each named once: header, writer and reader all follow this list.
namespace kestrel::log_format {

template <class Value, class Field>
void visit_vector(Field& field, const std::array<const char*, 3>& names, Value& vector) {
  for (int i = 0; i < 3; ++i) field(names[std::size_t(i)], vector[i]);
}

template <class Command, class Field>
void visit_command(Field& field, const std::array<const char*, 4>& names, Command& command) {
  field(names[0], command.forward_m_s);
  field(names[1], command.right_m_s);
  field(names[2], command.down_m_s);
  field(names[3], command.yaw_rate_rad_s);
}

template <class Row, class Field>
void visit_track(Row& row, Field& field) {
  field("frame", row.frame);
  field("stamp_s", row.stamp_s);
  field("status", row.status);
  field("stage", row.stage);
  field("miss", row.miss);
  field("age_s", row.age_s);
  field("confidence", row.confidence);
  field("alike_share", row.alike_share);
  field("window_u_px", row.window.u);
  field("window_v_px", row.window.v);
  field("window_width_px", row.window.width);
  field("window_height_px", row.window.height);
  field("keypoints", row.keypoints);
  field("matches", row.matches);
  field("inliers", row.inliers);
  field("trials", row.trials);
  field.group(row.image_from_template, [](auto& homography, auto& f) {
    static constexpr std::array<std::array<const char*, 3>, 3> kNames{
        {{"h00", "h01", "h02"}, {"h10", "h11", "h12"}, {"h20", "h21", "h22"}}};
    for (int r = 0; r < 3; ++r)
      for (int c = 0; c < 3; ++c) f(kNames[std::size_t(r)][std::size_t(c)], homography.H(r, c));
  });
  field.group(row.corners, [](auto& corners, auto& f) {
    static constexpr std::array<std::array<const char*, 2>, 4> kNames{
        {{"corner0_u_px", "corner0_v_px"},
         {"corner1_u_px", "corner1_v_px"},
         {"corner2_u_px", "corner2_v_px"},
         {"corner3_u_px", "corner3_v_px"}}};
    for (std::size_t i = 0; i < 4; ++i) {
      f(kNames[i][0], corners[i].u);
      f(kNames[i][1], corners[i].v);
    }
  });
  field.group(row.predicted, [](auto& corners, auto& f) {
    static constexpr std::array<std::array<const char*, 2>, 4> kNames{
        {{"predicted0_u_px", "predicted0_v_px"},
         {"predicted1_u_px", "predicted1_v_px"},
         {"predicted2_u_px", "predicted2_v_px"},
         {"predicted3_u_px", "predicted3_v_px"}}};
    for (std::size_t i = 0; i < 4; ++i) {
      f(kNames[i][0], corners[i].u);
      f(kNames[i][1], corners[i].v);
    }
  });
  field.group(row.noise, [](auto& noise, auto& f) {
    static constexpr std::array<std::array<const char*, 3>, 4> kNames{
        {{"corner0_var_u_px2", "corner0_cov_uv_px2", "corner0_var_v_px2"},
         {"corner1_var_u_px2", "corner1_cov_uv_px2", "corner1_var_v_px2"},
         {"corner2_var_u_px2", "corner2_cov_uv_px2", "corner2_var_v_px2"},
         {"corner3_var_u_px2", "corner3_cov_uv_px2", "corner3_var_v_px2"}}};
    for (std::size_t i = 0; i < 4; ++i)
      for (std::size_t k = 0; k < 3; ++k) f(kNames[i][k], noise[i][k]);
  });
  field.group(row.attitude, [](auto& attitude, auto& f) {
    f("roll_rad", attitude.roll);
    f("pitch_rad", attitude.pitch);
    f("yaw_rad", attitude.yaw);
  });
}

template <class Row, class Field>
void visit_decision(Row& row, Field& field) {
  field.group(row.pose, [](auto& pose, auto& f) {
    visit_vector(f, {"pose_tx_m", "pose_ty_m", "pose_tz_m"}, pose.translation_m);
    visit_vector(f, {"pose_tux_rad", "pose_tuy_rad", "pose_tuz_rad"}, pose.rotation_rad);
    f("reprojection_px", pose.reprojection_px);
    f("has_rival", pose.has_rival);
  });
  field.group(row.servo, [](auto& servo, auto& f) {
    static constexpr std::array<const char*, 8> kNames{"e0", "e1", "e2", "e3",
                                                       "e4", "e5", "e6", "e7"};
    for (std::size_t i = 0; i < 8; ++i) f(kNames[i], servo.error[i]);
    f("error_norm", servo.error_norm);
    f("condition", servo.condition);
    visit_vector(f, {"vc_x_m_s", "vc_y_m_s", "vc_z_m_s"}, servo.twist.linear);
    visit_vector(f, {"wc_x_rad_s", "wc_y_rad_s", "wc_z_rad_s"}, servo.twist.angular);
  });
  field.group(row.decision, [](auto& decision, auto& f) {
    f("state", decision.state);
    visit_command(
        f, {"wanted_forward_m_s", "wanted_right_m_s", "wanted_down_m_s", "wanted_yaw_rate_rad_s"},
        decision.wanted);
    visit_command(f, {"sent_forward_m_s", "sent_right_m_s", "sent_down_m_s", "sent_yaw_rate_rad_s"},
                  decision.sent);
  });
}

/// Calls field(name, value) for each column in order, and field.group(optional, fields) where
/// columns have values only together.
template <class Row, class Field>
void visit(Row& row, Field& field) {
  visit_track(row, field);
  visit_decision(row, field);
}

}  // namespace kestrel::log_format
